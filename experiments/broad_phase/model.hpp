#pragma once
/// Worlds of moving balls at constant density, those who find the pairs of boxes that touch in them, and what they find.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <thinwall/discrete/broad_phase/proxy.hpp>
#include <thinwall/discrete/sphere.hpp>
#include <thinwall/experiments/lab/factors.hpp>
#include <thinwall/experiments/lab/race.hpp>
#include <thinwall/experiments/lab/record.hpp>
#include <thinwall/swept/moving.hpp>

namespace thinwall {

/// What a world is like. Its balls do not depend on how they are looked at.
struct CrowdFactors {
  std::string placement =
      "uniform";           ///< or "clustered": in heaps of 100 on average, each as dense as ten times the whole
  double speed = 1;        ///< [m] the path of a step, in any direction
  std::int64_t count = 0;  ///< [1]
  double density = 0.1;    ///< [1 / m^3]
};

extern const Factors<CrowdFactors> crowd_factors;

using Crowd = std::vector<Moving<Sphere<double>>>;

inline constexpr double crowd_radius = 0.5;  // [m]

/// Balls in a cube of the volume that the density asks for, in no order of place.
Crowd make_crowd(const CrowdFactors& factors, std::uint64_t seed);

/// The same balls one step later.
Crowd next_step(const Crowd& crowd);

/// The boxes that hold them during the step.
std::vector<Proxy> proxies_of(const Crowd& crowd);

/// How many of the pairs of boxes are of balls that meet during the step.
std::int64_t count_meetings(const Crowd& crowd, const std::vector<ProxyPair>& pairs);

/// Whoever finds pairs, behind one interface: ours, and Bullet's where it was built in. Keeps its memory, and Bullet its tree,
/// from call to call.
class Finder {
 public:
  virtual ~Finder() = default;
  /// What is timed: from the boxes of this step to all pairs.
  virtual void find(std::span<const Proxy> proxies) = 0;
  /// What the last call found, sorted. Not timed.
  virtual std::vector<ProxyPair> pairs() const = 0;
  /// [bytes] beside the proxies; nothing where it cannot be told.
  virtual std::optional<std::size_t> bytes() const = 0;
  /// Finds exactly the pairs whose boxes touch; or else these and more.
  virtual bool is_exact() const = 0;
  /// What it finds depends on the steps that it has seen before.
  virtual bool moves_on() const { return false; }
};

/// All that this program has, in the order of tables.
std::vector<std::string_view> finder_names();

/// `name` is one of those.
std::unique_ptr<Finder> make_finder(std::string_view name);

/// The names of Bullet's, in the program or not.
inline constexpr std::string_view bullet_build_name = "bullet_build";  ///< its tree built anew
inline constexpr std::string_view bullet_step_name = "bullet_step";    ///< its tree moved on from the last call

/// Nothing where the program was built without Bullet.
std::unique_ptr<Finder> make_bullet_finder(bool keeps_tree);
bool has_bullet();

/// One broad phase on one world.
struct Finding {
  std::string finder;
  bool is_exact = true;
  std::int64_t pairs = 0, missing = 0, extra = 0;
  std::optional<std::int64_t> bytes;
  std::vector<double> milliseconds = {};  ///< one of each round

  static constexpr auto fields() {
    using F = Finding;
    return record(kept("broad_phase", &F::finder, "", "Who finds the pairs."), kept("is_exact", &F::is_exact),
                  kept("found", &F::pairs, "1", "Pairs found."),
                  kept("missing", &F::missing, "1", "Pairs whose boxes touch and that were not found."),
                  kept("extra", &F::extra, "1", "Pairs found whose boxes do not touch."),
                  kept("bytes", &F::bytes, "byte", "Working memory and pairs."), kept("rounds", &F::milliseconds));
  }
  /// Nothing is missing, and what claims to be exact finds nothing else.
  bool is_right() const { return missing == 0 && (!is_exact || extra == 0); }
};

struct Survey {
  std::int64_t pairs = 0, meetings = 0;
  std::vector<Finding> findings;

  static constexpr auto fields() {
    using S = Survey;
    return record(kept("pairs", &S::pairs, "1", "Pairs whose boxes touch during the step: the candidates."),
                  kept("meetings", &S::meetings, "1", "Of those, pairs of balls that touch during the step."),
                  kept("findings", &S::findings));
  }
};

struct SurveyOptions {
  std::vector<std::string> finders;
  std::int64_t loops_up_to = 0, sweep_up_to = 0;  ///< [1] bodies
  std::int64_t rounds = 3;                        ///< >= 1
  double seconds = 1;  ///< [s] for each finder; no round begins later, but for the first three
  std::uint64_t seed = 0;
};

/// Those of the options that are not too slow for so many bodies.
std::vector<std::string> finders_for(std::int64_t count, const SurveyOptions& options);

/// Times by the processor time of the thread, one survey at a time. Each round gives every finder the boxes of a step,
/// one step and the next in turn, so that trees that are moved on have something to move.
/// What is right is what the finders that are exact agree on: `missing` and `extra` are against the first of them.
Survey survey(const CrowdFactors& factors, const SurveyOptions& options);

// ---- What the surveys say: how times grow with the count, where the half loop is overtaken, and whether all are right.

struct GrowthPoint {
  double count;  ///< > 0
  double cost;   ///< > 0
};

/// The exponent p of cost = c * count^p, its interval from how far the points lie off the line; a bend widens it: the straight
/// line of least squares through the logarithms; nothing for fewer than three different counts.
/// Source: ordinary least squares, the interval from Student's t with two degrees of freedom less than points.
std::optional<Measured> fit_growth(std::span<const GrowthPoint> points);

/// A world and its survey.
struct SurveyRow {
  CrowdFactors crowd;
  Survey survey;
};

/// One broad phase on one world.
struct FindingRow {
  CrowdFactors crowd;
  Finding finding;
};
std::vector<FindingRow> findings_of(const std::vector<SurveyRow>& rows);

/// The finding of that name, or null.
const Finding* finding_of(const Survey& survey, std::string_view finder);

/// One broad phase over the counts of one kind of world.
struct Course {
  CrowdFactors crowd;  ///< `count` is not meant
  std::string finder;
  std::int64_t counts = 0;         ///< of `growth_from` and more
  std::optional<Measured> growth;  ///< exponent over those
};

inline constexpr std::int64_t growth_from = 10000;  ///< [bodies] below, fixed costs and caches rule

/// In the order of the rows.
std::vector<Course> courses(const std::vector<SurveyRow>& rows);

/// The largest count up to which the half loop is the quickest in all worlds; 0 if never or not run.
std::int64_t loop_is_best_up_to(const std::vector<SurveyRow>& rows);

/// No finder misses a pair, and none that claims to be exact finds another.
bool all_right(const std::vector<SurveyRow>& rows);

}  // namespace thinwall
