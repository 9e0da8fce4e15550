#pragma once
/// A heat map over all places: columns are the values of all axes, side by side; a row is whatever is compared.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <thinwall/experiments/extremes/axes.hpp>
#include <thinwall/experiments/figure.hpp>

namespace thinwall {

/// A class of values and its color.
struct HeatBin {
  std::string label;
  std::string color;  ///< #rrggbb
};

/// The bin of one row at one place; nothing leaves it white.
using BinAt = std::function<std::optional<std::size_t>(std::size_t row, const Place& place)>;

Panel heat_panel(const std::string& title, const std::vector<Place>& places, const std::vector<std::string>& rows,
                 const std::vector<HeatBin>& bins, bool names_axes, const BinAt& bin_at);

/// The first bin whose upper limit is not below x; the last has none.
std::size_t bin_of(double x, const std::vector<double>& limits);

}  // namespace thinwall
