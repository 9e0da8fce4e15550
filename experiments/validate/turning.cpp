#include <thinwall/experiments/validate/turning.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <string_view>
#include <system_error>

#include <fmt/format.h>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include <thinwall/experiments/lab/escape.hpp>
#include <thinwall/experiments/lab/settings.hpp>
#include <thinwall/experiments/lab/statistics.hpp>
#include <thinwall/experiments/lab/text.hpp>
#include <thinwall/experiments/validate/validate.hpp>
#include <thinwall/swept/certified/turning_certified.hpp>
#include <thinwall/swept/members.hpp>

namespace thinwall {

namespace {

namespace fs = std::filesystem;

/// Holds 30 decimals, and the difference to a double.
using ExactTime =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;

/// What the file says of a query.
struct TurningTruth {
  ToiStatus verdict = ToiStatus::apart;
  ExactTime time = 0;    ///< [1] first contact, rounded down to 30 decimals
  double clearance = 0;  ///< [length] of what is apart: proven
  std::size_t line = 0;

  bool touches() const { return verdict != ToiStatus::apart; }
};

// ---- Reading.

template <class A> constexpr std::string_view shape_word{};
template <> constexpr std::string_view shape_word<Sphere<double>> = "sphere";
template <> constexpr std::string_view shape_word<Capsule<double>> = "capsule";
template <> constexpr std::string_view shape_word<Obb<double>> = "obb";
template <> constexpr std::string_view shape_word<Triangle<double>> = "triangle";

constexpr std::size_t answer_columns = 6;
template <class A, class B> std::string header_text(const Turning<A>& a, const Turning<B>& b) {
  std::string text = "query,motion,aim,verdict,time,clearance";
  for_each_named_number(a, [&](const std::string& name, const double&) { text += ",a_" + name; });
  for_each_named_number(b, [&](const std::string& name, const double&) { text += ",b_" + name; });
  return text;
}

double number_in(const QueryLines& file, std::string_view field, std::size_t column) {
  const auto value = parsed<double>(field);
  if (!value || !std::isfinite(*value)) file.complain(field, column, "is not a finite number");
  return *value;
}

TurningTruth truth_of(const QueryLines& file, const std::vector<std::string_view>& fields) {
  constexpr std::size_t verdict = 3, time = 4, clearance = 5;
  TurningTruth truth;
  truth.line = file.line();
  if (fields[verdict] == "hit") {
    truth.verdict = ToiStatus::hit;
  } else if (fields[verdict] == "overlapping") {
    truth.verdict = ToiStatus::overlapping;
  } else if (fields[verdict] != "apart") {
    file.complain(fields[verdict], verdict, "is no verdict; apart, hit or overlapping");
  }
  if (truth.touches()) {
    const std::string_view text = fields[time];
    const bool has_digits = text.find_first_of("0123456789") != std::string_view::npos;
    const bool is_decimal = text.find_first_not_of("0123456789.") == std::string_view::npos &&
                            std::ranges::count(text, '.') <= 1 && text.size() <= 64 && has_digits;
    if (!is_decimal) file.complain(text, time, "is not a decimal number from 0 to 1");
    truth.time = ExactTime(std::string(text));
    if (truth.time > 1) file.complain(text, time, "is not a decimal number from 0 to 1");
    if (truth.verdict == ToiStatus::overlapping && truth.time != 0) file.complain(text, time, "is not the start");
    if (!fields[clearance].empty()) file.complain(fields[clearance], clearance, "is too much: they touch");
  } else {
    if (!fields[time].empty()) file.complain(fields[time], time, "is too much: they stay apart");
    truth.clearance = number_in(file, fields[clearance], clearance);
    if (truth.clearance < 0) file.complain(fields[clearance], clearance, "is less than 0");
  }
  return truth;
}

std::vector<fs::path> turning_files(const fs::path& place) {
  std::error_code error;
  const std::string said = one_line(place.string());
  if (!fs::exists(place, error)) throw UsageError(said + ": there is no such file or folder");
  if (fs::is_directory(place, error)) return query_files(place, false);
  if (!fs::is_regular_file(place, error)) throw UsageError(said + ": is not a regular file; no other is read");
  return {place};
}

// ---- Asking and judging.

/// A time that a method answers, or the two ends of its bracket.
struct TimedAnswer {
  ToiStatus status;
  double lower, upper;
};

/// [length] a step, at least as fast as the fastest point of a body.
template <class A> double fastest_point(const Turning<A>& m) {
  double farthest = 0;
  if constexpr (std::is_same_v<A, Capsule<double>>) farthest = norm<double>(m.shape.b - m.shape.a) / 2;
  if constexpr (std::is_same_v<A, Obb<double>>) farthest = norm<double>(m.shape.half_extents);
  if constexpr (std::is_same_v<A, Triangle<double>>) {
    for (const Vec3<double>& corner : {m.shape.a, m.shape.b, m.shape.c})
      farthest = std::max(farthest, norm<double>(corner - center(m.shape)));
  }
  return norm<double>(m.displacement) + norm<double>(m.rotation) * farthest;
}

template <class A> double radius_of(const A& shape) {
  if constexpr (requires { shape.radius; }) return shape.radius;
  return 0;
}

/// [length] what rounding may hide of a gap. Where neither has a radius, the direction between closest points is lost before the gap is.
template <class A, class B> double rounding_of(const Turning<A>& a, const Turning<B>& b) {
  const double size = magnitude(a) + magnitude(b);
  if (radius_of(a.shape) + radius_of(b.shape) == 0) return 0x1p-26 * size;
  const double turns = 1 + (norm<double>(a.rotation) + norm<double>(b.rotation)) / 4;
  return 0x1p-43 * turns * size;
}

/// Counts an answer and says what is wrong with it, if that breaks what the method claims. `contact` [length] is called contact.
std::string judged(const TimedAnswer& answer, const TurningTruth& truth, double contact, const TurningMethod& method,
                   TurningCounts& counts) {
  static const ExactTime last_place("2e-30");
  ++counts.queries;
  counts.touching += truth.touches() ? 1 : 0;
  if (answer.status == ToiStatus::invalid) return "the input is called invalid";
  if (answer.status == ToiStatus::gave_up) {
    ++counts.gave_up;
    return "";
  }
  const bool said = answer.status != ToiStatus::apart;
  if (!said && truth.touches()) {
    ++counts.missed;
    return method.never_late ? "missed" : "";
  }
  if (said && !truth.touches()) {
    ++counts.false_hits;
    const bool is_near = truth.clearance <= contact;
    counts.near += is_near ? 1 : 0;
    return method.hits_are_true && !is_near ? "a hit of what stays apart" : "";
  }
  if (!said) return "";
  const ExactTime after = ExactTime(answer.lower) - truth.time;
  const auto error = after.convert_to<double>();
  counts.largest_error = std::max(counts.largest_error, std::abs(error));
  if (after > last_place) {
    ++counts.late;
    return method.never_late ? fmt::format("late by {:.1e} of a step", error) : "";
  }
  if (ExactTime(answer.upper) < truth.time) return "proves a contact before that of the file";
  return "";
}

/// Everything that is asked, in one order: f(method, tolerance [1], ask), where ask(a, b) answers.
template <class F> void each_turning_method(const F& f) {
  const auto by = [](const auto& method) {
    return [method](const auto& a, const auto& b) {
      const Toi<double> toi = time_of_impact(method, a, b);
      return TimedAnswer{toi.status, toi.time, 1};
    };
  };
  f(TurningMethod{"end_of_step", false, true}, 0.0, by(EndOfStep<double>{}));
  f(TurningMethod{"substeps_4", false, true}, 0.0, by(Substeps<double>{4}));
  f(TurningMethod{"linear_sweep", false, false}, 0.0, by(LinearSweep<double>{}));
  f(TurningMethod{"speculative", true, false}, 0.0, by(Speculative<double>{}));
  const ConservativeAdvancement<double> front_door, fine{.tolerance = 0x1p-40, .max_evaluations = 256};
  f(TurningMethod{"conservative_advancement", true, true}, front_door.tolerance, by(front_door));
  f(TurningMethod{"conservative_advancement, 2^-40", true, true}, fine.tolerance, by(fine));
  f(TurningMethod{"certified", true, true}, 0.0, [](const auto& a, const auto& b) {
    const CertifiedToi proven = certified_time_of_impact(a, b);
    return TimedAnswer{proven.verdict, proven.lower, proven.upper};
  });
}

constexpr std::size_t most_turning_wrongs = 20;

class TurningJudge {
 public:
  TurningJudge() {
    each_turning_method([&](const TurningMethod& method, double, const auto&) { result_.methods.push_back(method); });
    result_.total.resize(result_.methods.size());
    nanoseconds_.resize(result_.methods.size());
  }

  void judge_file(const fs::path& path) {
    QueryLines file(path);
    if (!file.next()) file.refuse("the file is empty; a header and a line a query");
    using Ball = Sphere<double>;
    using Rod = Capsule<double>;
    using Box = Obb<double>;
    using Plate = Triangle<double>;
    const bool known = judge_pair<Ball, Ball>(file) || judge_pair<Rod, Ball>(file) || judge_pair<Rod, Rod>(file) ||
                       judge_pair<Box, Ball>(file) || judge_pair<Box, Rod>(file) || judge_pair<Box, Box>(file) ||
                       judge_pair<Plate, Ball>(file) || judge_pair<Plate, Rod>(file);
    if (!known) file.refuse("not the header of a pair of shapes that turn; see docs/data/README.md");
  }

  TurningValidation result() {
    for (const std::vector<double>& times : nanoseconds_)
      result_.median_ns.push_back(times.empty() ? 0 : median(times));
    return std::move(result_);
  }

 private:
  /// False if the header is of another pair.
  template <class A, class B> bool judge_pair(QueryLines& file) {
    Turning<A> a{};
    Turning<B> b{};
    if (file.text() != header_text(a, b)) return false;
    TurningPairCounts pair{fmt::format("{}, {}", shape_word<A>, shape_word<B>), {}};
    pair.counts.resize(result_.methods.size());
    const auto columns = static_cast<std::size_t>(std::ranges::count(file.text(), ',')) + 1;
    bool any = false;
    for (; file.next(); any = true) {
      const std::vector<std::string_view> fields = file.fields(columns);
      const TurningTruth truth = truth_of(file, fields);
      std::size_t column = answer_columns;
      const auto read = [&](double& number) {
        number = number_in(file, fields[column], column);
        ++column;
      };
      for_each_number(a, read);
      for_each_number(b, read);
      if (!valid(a)) file.refuse(fmt::format("A is no valid {}", shape_word<A>));
      if (!valid(b)) file.refuse(fmt::format("B is no valid {}", shape_word<B>));
      judge_query(file, truth, a, b, pair.counts);
    }
    if (!any) file.refuse("no query follows the header");
    for (std::size_t i = 0; i < pair.counts.size(); ++i) result_.total[i] += pair.counts[i];
    result_.pairs.push_back(std::move(pair));
    return true;
  }

  template <class A, class B>
  void judge_query(const QueryLines& file, const TurningTruth& truth, const Turning<A>& a, const Turning<B>& b,
                   std::vector<TurningCounts>& counts) {
    using Clock = std::chrono::steady_clock;
    std::size_t i = 0;
    each_turning_method([&](const TurningMethod& method, double tolerance, const auto& ask) {
      const Clock::time_point start = Clock::now();
      const TimedAnswer answer = ask(a, b);
      nanoseconds_[i].push_back(std::chrono::duration<double, std::nano>(Clock::now() - start).count());
      const double contact =
          tolerance > 0 ? std::max(tolerance * (fastest_point(a) + fastest_point(b)), rounding_of(a, b)) : 0;
      const std::string wrong = judged(answer, truth, contact, method, counts[i]);
      ++i;
      if (wrong.empty()) return;
      if (++result_.wrong > static_cast<std::int64_t>(most_turning_wrongs)) return;
      result_.wrongs.push_back(fmt::format("{}:{}: {}: {}", file.shown(), truth.line, method.name, wrong));
    });
  }

  TurningValidation result_;
  std::vector<std::vector<double>> nanoseconds_;
};

}  // namespace

TurningValidation validate_turning(const fs::path& file_or_folder) {
  TurningJudge judge;
  for (const fs::path& file : turning_files(file_or_folder)) judge.judge_file(file);
  return judge.result();
}

}  // namespace thinwall
