#pragma once
/// A panel of a figure, stated by the columns of a table.
///
///   Figure f = {.name = "probability", .title = "...", .caption = "...", .panels = {
///       plot(cells).where("wall", "infinite").x("step_ratio", Axis::log).y("probability").by("method")
///           .curve("theory", [](double x) { return miss_probability(x); }),
///       plot(cells).x("step_ratio", Axis::log).y("residual").by("method")}};
///
/// A series for each value of the `by` column, in the order of the rows; bars where the x or the y column has an interval; rows
/// without x or y are left out. A method looks the same in every figure: lab/method_looks.hpp.

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <thinwall/experiments/lab/columns.hpp>
#include <thinwall/experiments/lab/figure.hpp>
#include <thinwall/experiments/lab/table.hpp>

namespace thinwall {

enum class Axis { linear, log };

/// Points of a curve, `steps` apart evenly on such an axis, to the end of the series.
void add_curve(Series& series, double from, double to, Axis axis, const std::function<double(double)>& f, int steps);

class Plot {
 public:
  explicit Plot(const Table& table) : table_(table) {}

  /// Only the rows in which the column reads as this value does.
  Plot& where(std::string_view column, const Value& value);
  /// Only the rows in which the number in the column is such; a missing one is not.
  Plot& where(std::string_view column, const std::function<bool(double)>& is_it);

  /// `label` in place of the column's name and unit.
  Plot& x(std::string_view column, Axis axis = Axis::linear, std::string label = "");
  Plot& y(std::string_view column, Axis axis = Axis::linear, std::string label = "");
  Plot& by(std::string_view column);
  Plot& label(std::string label);  ///< of the only series, where there is no `by`
  Plot& mark(Mark mark);
  Plot& height(double share);

  /// A line over the range of x that the rows have, or from `from` to `to`; NaN leaves a gap, as there is one between curves of
  /// one label.
  Plot& curve(std::string label, const std::function<double(double)>& f, Mark mark = Mark::line);
  Plot& curve(std::string label, const std::function<double(double)>& f, double from, double to,
              Mark mark = Mark::line);
  /// The same at one height.
  Plot& level(const std::string& label, double y, Mark mark = Mark::line) {
    const auto everywhere = [y](double) { return y; };
    return curve(label, everywhere, mark);
  }
  Plot& line(std::string label, std::vector<double> xs, std::vector<double> ys, Mark mark = Mark::line);
  /// A line for each value of the `by` column, from left to right through what another column says. After `x` and `by`.
  Plot& through(std::string_view column, const std::string& label);

  operator Panel() const;  // NOLINT(google-explicit-constructor): it stands where a panel does

 private:
  struct Curve {
    std::string label;
    std::function<double(double)> f;
    double from, to;
    Mark mark;
  };

  Table table_;
  Panel panel_;
  std::string x_, y_, by_, label_;
  Mark mark_ = Mark::points;
  std::vector<Curve> curves_;
};

inline Plot plot(const Table& table) { return Plot(table); }

/// Without the panels in which nothing was measured, and without the figures that then have none.
std::vector<Figure> only_measured(std::vector<Figure> figures);

/// Of columns that no table of the result has.
template <class Row, class... Parts> Plot plot(const std::vector<Row>& rows, const Parts&... parts) {
  return Plot(table("drawn", "", rows, parts...));
}

/// With a line through the points of each series, below them.
Panel joined(Panel panel);

/// Series of points that lie on the zero line would hide each other: they take turns on it.
Panel taking_turns(Panel panel);

}  // namespace thinwall
