#pragma once
/// What rounds of timing give: the clock they read, the median with its interval, and the columns of such a measurement.

#include <ctime>

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <thinwall/experiments/lab/columns.hpp>
#include <thinwall/experiments/random.hpp>
#include <thinwall/experiments/statistics.hpp>

namespace thinwall {

/// [s] of the processor that this thread has had: what others do meanwhile does not count.
inline double thread_seconds() {
  std::timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct Measured {
  double value;
  Interval interval;  ///< 95 %

  Measured times(double factor) const { return {factor * value, {factor * interval.lower, factor * interval.upper}}; }
};

/// The median, and its interval by bootstrap over the rounds. Not empty.
inline Measured median_of_rounds(const std::vector<double>& rounds) {
  const std::array<double, 1> key = {static_cast<double>(rounds.size())};
  return {median(rounds), bootstrap_median(rounds, {1, stream_of(key)})};
}

/// A Measured, or an optional one, and the ends of its interval, `PREFIX_lower` and `PREFIX_upper`.
template <class Get> struct MeasuredColumns {
  std::string name, unit, description, prefix;
  Get get;

  template <class Row> void add_to(Columns<Row>& columns) const {
    const auto read = [get = get](auto part) {
      return [get, part](const Row& row) -> std::optional<double> {
        const std::optional<Measured> m = std::invoke(get, row);
        return m ? std::optional(part(*m)) : std::nullopt;
      };
    };
    const std::string lower = prefix + "lower", upper = prefix + "upper";
    ValueColumn{name, unit, description, read([](const Measured& m) { return m.value; }), lower, upper}.add_to(columns);
    value(lower, unit, "Lower end of its 95 % interval.", read([](const Measured& m) { return m.interval.lower; }))
        .add_to(columns);
    value(upper, unit, "Upper end of its 95 % interval.", read([](const Measured& m) { return m.interval.upper; }))
        .add_to(columns);
  }
};
template <class Get>
MeasuredColumns<Get> measured(std::string name, std::string unit, std::string description, Get get,
                              std::string prefix = "") {
  return {std::move(name), std::move(unit), std::move(description), std::move(prefix), std::move(get)};
}

}  // namespace thinwall
