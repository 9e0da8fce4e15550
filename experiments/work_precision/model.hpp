#pragma once
/// Races of the methods on the same queries: what takes part, what came of it, and how the racers of a heat compare. The queries
/// and the races themselves are in sets/sets.cpp.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <thinwall/experiments/lab/race.hpp>
#include <thinwall/experiments/lab/record.hpp>

namespace thinwall {

struct RaceOptions {
  std::vector<std::string> methods;  ///< by name, of the method list
  /// From rough to fine: [1] epsilon of double to 1; those that float cannot resolve are left out for it.
  std::vector<double> tolerances;
  std::vector<std::int64_t> poses;  ///< [1] >= 1, ascending, of methods with a number of poses
  std::int64_t queries = 0;         ///< >= 1, of each set, class and scalar
  std::int64_t rounds = 0;          ///< >= 1
  std::uint64_t seed = 0;
};

/// Errors of the time of impact where the bodies touch and the method says so, or infinity where it does not say so.
struct ErrorSpread {
  double median = 0, p99 = 0, max = 0;
  static constexpr auto fields() {
    using T = ErrorSpread;
    return record(kept("median", &T::median), kept("p99", &T::p99), kept("max", &T::max));
  }
};

/// What came of one method at one setting, over all queries of a set, class and scalar.
struct Racer {
  std::string method{};
  std::string setting{};           ///< "tolerance 1e-06"; empty for a method without an option
  std::optional<double> option{};  ///< its value
  std::int64_t queries = 0, touching = 0, missed = 0, false_hits = 0, gave_up = 0;
  ErrorSpread time{};          ///< [1] of a step
  ErrorSpread length{};        ///< [m] the same along the relative path
  double latest = no_most;     ///< [1] of a step, <= 0 if never late
  double earliest = no_least;  ///< [1] of a step, >= 0 if never early
  double forward = 0;          ///< [u kappa t] largest error, in units of what the closed form may err by
  double evaluations = 0;      ///< [1] a query, on average
  std::int64_t most_evaluations = 0;
  std::vector<double> nanoseconds{};  ///< a query, one of each round; the rounds of all racers are interleaved

  static constexpr auto fields() {
    using T = Racer;
    return record(
        kept("method", &T::method, "", "Way to find the time of impact."), kept("setting", &T::setting),
        kept("option", &T::option, "1", "Its tolerance or number of poses; missing where it has none."),
        kept("queries", &T::queries, "1", "Queries put."),
        kept("touching", &T::touching, "1", "Of those, that touch during the step, by the oracle."),
        kept("missed", &T::missed, "1", "Touching, and said to be apart."),
        kept("false_hits", &T::false_hits, "1", "Not touching, and said to hit."),
        kept("gave_up", &T::gave_up, "1", "Not decided."), part(&T::time), part(&T::length),
        most("latest", &T::latest, "step", "Answer that is latest after first contact; negative: all are before."),
        least("earliest", &T::earliest, "step", "Answer that is earliest; positive: all are after."),
        kept("forward", &T::forward),
        kept("evaluations", &T::evaluations, "1",
             "Separations, overlap tests, rays or closed forms a query, on average."),
        kept("most_evaluations", &T::most_evaluations, "1", "The most that a query took."),
        kept("nanoseconds", &T::nanoseconds));
  }
};

enum class QueryClass {
  hit,    ///< they touch; first contact is uniform over the step
  miss,   ///< one passes beside the other
  graze,  ///< the path is within 1e-8 (in float 1e-3) to 1e-2 of its offset from the last that touches, on either side
};
constexpr std::string_view name(QueryClass kind) {
  constexpr std::array<std::string_view, 3> names{"hit", "miss", "graze"};
  return names[static_cast<std::size_t>(kind)];
}

/// A pair of shapes, and how they are drawn.
struct QuerySet {
  std::string_view name;                  ///< as in the settings
  std::string_view title;                 ///< "a ball and a thin wall"
  bool turns;                             ///< up to a quarter turn a step; there is no closed form then
  std::vector<std::string_view> methods;  ///< that serve the pair
  std::vector<Racer> (*in_float)(QueryClass kind, const RaceOptions& options);
  std::vector<Racer> (*in_double)(QueryClass kind, const RaceOptions& options);
};
std::span<const QuerySet> query_sets();

/// One race: a set of queries, a class and a scalar, and all who took part.
struct Heat {
  const QuerySet* set;
  QueryClass kind;
  std::string scalar;
  std::vector<Racer> racers;
};

Measured nanoseconds(const Racer& racer);                   ///< [ns] a query: the median over the rounds
Measured slowdown(const Racer& racer, const Racer& other);  ///< [1] times as long as the other, round by round

/// [1] of a step: a method whose 99th percentile error is no more finds the time about as well as the scalar can say it.
double fine_error(std::string_view scalar);

/// It misses no contact of the heat and decides every query, so that its errors are all there.
bool finishes(const Racer& racer);

/// Those who finish and whom nobody beats in both 99th percentile error and time, from the finest to the coarsest.
std::vector<const Racer*> pareto_front(const Heat& heat);

/// Of every method one racer, in the order of the list: the roughest setting that is fine, or else the finest there is.
std::vector<const Racer*> one_a_method(const Heat& heat);

/// [1] The share of the misses of a heat's set and scalar that a racer of the heat calls a hit; missing if none were asked.
std::optional<double> false_share(const std::vector<Heat>& heats, const Heat& heat, const Racer& racer);

/// The racer of `ClosedForm`, what all others are held against; null if it does not take part.
const Racer* closed_form_of(const Heat& heat);

/// Those, other than the closed form, that are fine and faster than it, by more than the intervals' width.
std::vector<const Racer*> fine_and_faster(const Heat& heat);

/// The closed form keeps its contract on every query of a heat: no wrong verdict, and no time off by more than 4 u kappa t.
/// True, too, if it does not take part. Of a set that turns: those that claim never to be late or miss are not and do not.
bool keeps_contract(const Heat& heat);

/// The result in words.
std::string work_precision_answer(const std::vector<Heat>& heats);

/// One set and scalar, hits: who is the cheapest at which error, and by how much the others trail.
std::string heat_text(const Heat& heat);

}  // namespace thinwall
