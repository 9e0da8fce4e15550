#pragma once
/// What to use under given conditions: `advise`, and what a run's configuration should be warned of.

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include <thinwall/experiments/lab/statistics.hpp>
#include <thinwall/experiments/lab/text.hpp>
#include <thinwall/experiments/models/shot_methods.hpp>
#include <thinwall/experiments/models/shots.hpp>
#include <thinwall/swept/turning.hpp>

namespace thinwall {

// ---- What the user of `thinwall advise` says: how the ball flies, and what must not happen to it.

/// [1] What a chance or a ratio may be off by for rounding; a chance no larger is none.
inline constexpr double no_chance = 0x1p-50;

/// What flies where it is no ball: a rod that tumbles. It spins about its middle, at right angles to an axis in the plane of the wall.
struct TumblingRod {
  double length;  ///< [m] end to end, more than twice the radius
  double spin;    ///< [deg/s] >= 0
};

struct Wish {
  Cell cell;                        ///< the wall is infinite
  double miss = 0;                  ///< [1] the largest acceptable chance that a shot tunnels, 0 to 1
  std::optional<double> late = {};  ///< [m] >= 0: the farthest a ball may get past first contact before it is seen
  std::optional<TumblingRod> rod = {};
};

/// The words behind the options, where given.
struct WishWords {
  std::optional<std::string> speed, radius, thickness, angle, step, fps, miss, late, length, spin;
};

/// Throws UsageError.
Wish read_wish(const WishWords& words);

// ---- Whom the advice chooses from: every method of the method list, as the thin wall fires it in double, and the certified
// answers. A method added to the list is here by itself; without a theory in models/shot_methods.cpp it is never
// advised.

/// A rod's step.
struct RodStep {
  Turning<Capsule<double>> rod;
  Moving<Obb<double>> wall;
};

struct Candidate {
  std::string name = {};  ///< as the thin wall calls it: substeps_8
  int poses = 0;          ///< [1] that it tests a step and nothing else; 0 if it does more
  bool fired = false;     ///< the thin wall can fire it
  std::function<Theory(const Cell&)> theory;
  std::function<void(std::span<const ShotStep>)> ask = {};     ///< to be timed
  std::function<void(std::span<const RodStep>)> ask_rod = {};  ///< of a rod, in its place
  std::function<Theory(const Cell&)> up_to_its_spin = {};      ///< of a rod: the worst at its spin and slower ones
  bool hits_falsely = false;  ///< of a rod: also where nothing touches by the end of the step
};

/// The numbers of poses a step that are offered: 2, 8, and the fewest that meet the wish if they are 2 to 1000.
std::vector<std::int64_t> offered_poses(const Wish& wish);
std::vector<std::int64_t> offered_poses(const Wish& wish, const std::function<Theory(int poses)>& theory);

std::vector<Candidate> candidates(const Wish& wish);

/// These, and the certified answers.
std::vector<Candidate> candidates_of(std::span<const ThinWallMethod> methods);

/// The same for a rod: the methods that turn. The theory is that of docs/spinning_rod.md.
std::vector<Candidate> rod_candidates(const Wish& wish);

/// Steps of the rod's flights, `back` steps before the one of first contact.
std::vector<RodStep> rod_steps(const Wish& wish, std::int64_t count, std::int64_t back);

// ---- What a step costs on this machine, method by method.

/// [ns] The median of one query. Which of the two kinds of steps is dearer differs from method to method.
struct StepCost {
  Measured clear;    ///< a step that ends before the wall
  Measured contact;  ///< the next one, in which the ball touches it

  const Measured& dearer() const { return clear.value > contact.value ? clear : contact; }
};

struct TimingEffort {
  std::int64_t queries = 2048;  ///< of each kind
  std::int64_t rounds = 61;
  double round_ns = 1e6;     ///< a method's turn in a round takes at most about this long
  std::int64_t repeats = 1;  ///< of each query, for a clock that would not see it once
};

/// `result[i]` is of `candidates[i]`. Takes about a second, but for coarse clocks and rods that turn many times a step.
std::vector<StepCost> measure_costs(const Cell& cell, std::span<const Candidate> candidates,
                                    const TimingEffort& effort = {});
/// The same of a rod's steps of both kinds.
std::vector<StepCost> measure_costs(const std::vector<RodStep>& clear, const std::vector<RodStep>& contact,
                                    std::span<const Candidate> candidates, const TimingEffort& effort = {});

// ---- Which method to take. Nothing is measured or printed in here: costs come in, the advice goes out.

struct AdviceRow {
  Candidate method;
  Theory theory;  ///< at the step of the wish
  StepCost cost;
  bool meets;  ///< the wish
  /// [s] At which it would, a rod at its spin and any slower one; nothing if it does at none.
  std::optional<double> longest_step;

  bool may_be_advised() const { return meets && !method.hits_falsely; }
};

struct Advice {
  Wish wish;
  /// Those that meet the wish first: the advised one, then by cost; then those that meet it and hit falsely; then the others.
  std::vector<AdviceRow> rows;

  const AdviceRow* advised() const { return !rows.empty() && rows.front().may_be_advised() ? &rows.front() : nullptr; }
};

/// To rounding, which formulas computed in double need. False where theory has no number for what is wished for.
bool meets_wish(const Wish& wish, const Theory& theory);

/// [s] The longest allowed step at which it is met, all else as wished: the chance and the lateness grow with the step.
std::optional<double> longest_step(const Wish& wish, const std::function<Theory(const Cell&)>& theory);

/// Advised is the cheapest that meets the wish, by the dearer of its two kinds of steps. Of those whose cost cannot be told
/// from its cost, because the intervals overlap, it is the one that is least late.
Advice advise(const Wish& wish, std::span<const Candidate> candidates, std::span<const StepCost> costs);

/// The same of all who can serve a ball, or a rod, once their costs are measured: about a second.
Advice advise(const Wish& wish);

// ---- The advice in words, for a terminal, and as JSON, for a script.

/// As rounded_text, but never more than `value` > 0: a bound that is safe to keep to.
std::string rounded_down_text(double value, int digits);

/// The advice itself: a sentence or two, of one line.
std::string advice_sentence(const Advice& advice);

/// All of it, at most 100 columns wide, ended by a newline.
std::string advice_text(const Advice& advice);

/// Every number, keys in order.
nlohmann::ordered_json advice_json(const Advice& advice);

// ---- The configuration of the thin wall that puts the advice to the test.

/// The first line of it.
inline constexpr const char* check_config_title = "# Puts an advice of `thinwall advise` to the test.";

/// TOML with the wish's very cell and every candidate that the experiment can fire; what theory expects of each is a
/// comment.
std::string config_text(const Wish& wish, std::span<const Candidate> candidates);

/// The same. Throws UsageError if the experiment refuses the cell.
std::string check_config(const Wish& wish, std::span<const Candidate> candidates);

}  // namespace thinwall
