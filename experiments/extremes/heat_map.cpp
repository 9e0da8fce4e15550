#include <thinwall/experiments/extremes/heat_map.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <thinwall/experiments/text/numbers.hpp>

namespace thinwall {

namespace {

constexpr double row_height = 22.0 / 360;  // [1] of a panel of height 1

/// The column of each place: one apart, two where another axis begins.
std::vector<double> columns_of(const std::vector<Place>& places) {
  std::vector<double> columns;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const bool begins = i > 0 && places[i].axis != places[i - 1].axis;
    columns.push_back(i == 0 ? 1 : columns.back() + (begins ? 2 : 1));
  }
  return columns;
}

/// 1e4, 1e-15, but 1, 10 and 0.1.
std::string short_value(double x) {
  if (x > 0.05 && x < 50) return rounded_text(x, 2);
  const double power = std::floor(std::log10(x) + 1e-9), leading = x / std::pow(10, power);
  return fmt::format("{}e{:.0f}", rounded_text(leading, 2), power);
}

}  // namespace

std::size_t bin_of(double x, const std::vector<double>& limits) {
  return static_cast<std::size_t>(std::lower_bound(limits.begin(), limits.end(), x) - limits.begin());
}

Panel heat_panel(const std::string& title, const std::vector<Place>& places, const std::vector<std::string>& rows,
                 const std::vector<HeatBin>& bins, bool names_axes, const BinAt& bin_at) {
  Panel panel;
  panel.x_label = "value on the axis named above, all others as usual [1]";
  panel.y_label = title;
  panel.height = row_height * (static_cast<double>(rows.size()) + 0.4);
  const std::vector<double> columns = columns_of(places);
  for (const HeatBin& bin : bins) {
    panel.series.push_back(
        {.label = bin.label, .mark = Mark::cells, .x = {}, .y = {}, .lower = {}, .upper = {}, .color = bin.color});
  }
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const double y = static_cast<double>(rows.size() - row);
    panel.y_tics.push_back({y, rows[row]});
    for (std::size_t i = 0; i < places.size(); ++i) {
      const std::optional<std::size_t> bin = bin_at(row, places[i]);
      if (!bin) continue;
      panel.series[*bin].x.push_back(columns[i]);
      panel.series[*bin].y.push_back(y);
    }
  }
  for (std::size_t i = 0; i < places.size(); ++i) panel.x_tics.push_back({columns[i], short_value(places[i].value)});
  for (const AxisInfo& axis : all_axes()) {
    double first = 0, last = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (places[i].axis != axis.axis) continue;
      if (first == 0) first = columns[i];
      last = columns[i];
    }
    if (names_axes && first > 0) panel.x_groups.push_back({(first + last) / 2, std::string(axis.title)});
  }
  return panel;
}

}  // namespace thinwall
