#pragma once
/// A world of bodies that moves in steps: options, bodies, what a step reports, its plan.

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include <thinwall/capsule/capsule.hpp>
#include <thinwall/discrete/collision_events.hpp>
#include <thinwall/discrete/scalar.hpp>
#include <thinwall/discrete/sphere.hpp>
#include <thinwall/experiments/lab/record.hpp>

namespace thinwall {

// ---- How a world steps, and what is asked of it.

/// What is looked at of the motion in a step.
enum class TimePolicy {
  discrete,      ///< the poses at its end, and nothing between
  substeps,      ///< the poses at the end of each of n equal parts
  clamp,         ///< all of it; a body stops where it first hits, and loses the rest of the step: what engines do
  event_driven,  ///< all of it; after a hit a body goes on at its new velocity, up to `max_events` times
};
/// As a scene spells them, in the order of TimePolicy.
inline constexpr std::array<std::string_view, 4> policy_names = {"discrete", "substeps", "clamp", "event_driven"};
inline std::string_view name_of(TimePolicy policy) { return policy_names[static_cast<std::size_t>(policy)]; }
std::string name_of(TimePolicy policy, int substeps);  ///< with their number, if it has substeps: `substeps_4`
TimePolicy policy_named(std::string_view name);        ///< one of policy_names
/// True of those that look at all of the motion.
inline bool sweeps(TimePolicy policy) { return policy == TimePolicy::clamp || policy == TimePolicy::event_driven; }

struct WorldOptions {
  Vec3<double> gravity = Vec3<double>::Zero();  ///< [m/s^2]
  TimePolicy policy = TimePolicy::event_driven;
  int substeps = 1;                  ///< >= 1; of TimePolicy::substeps alone
  int max_events = 16;               ///< >= 1: hits of a body in a step; after the last one it waits for the next step
  int contact_rounds = 8;            ///< >= 0: passes over the contacts at the start of a step, before anything moves
  double correction = 1;             ///< [1] in [0, 1]: part of a penetration that is undone at the end of a step
  std::string broad_phase = "auto";  ///< a name of BroadPhases; auto: as the plan decides
  bool response = true;              ///< false: bodies pass through each other, and the contacts are only told
  bool events = true;                ///< false: nobody reads them
  int end_after = 1;                 ///< >= 1: a contact ends on this many consecutive steps apart
  double gate = 0;                   ///< [1] >= 0: a pair of which neither moves more than this part of its least half
                                     ///< width is not swept but tested at the start of the step. 0: off
  bool full_plan = false;            ///< true: omit nothing, to show that what is omitted changes no outcome
  std::vector<std::string> keep = {};  ///< omissions not to make, by `PlanLine::what`: what one alone saves
  int threads = 1;                     ///< >= 1; of no effect on any result
  std::size_t max_pairs =
      std::size_t{1} << 24;  ///< >= 1: more candidate pairs than this stop the step with TooManyPairs
};

// ---- What a world is made of: a body has a shape, or none, moves, and turns if it is to.

/// A shape that every other of the list can meet, or none.
using AnyShape = std::variant<std::monostate, Sphere<double>, Aabb<double>, Obb<double>, Capsule<double>>;

/// What `use` says of the shape; `none` where there is none.
template <class Answer> Answer of_shape(const AnyShape& shape, const Answer& none, const auto& use) {
  return std::visit(
      [&]<class A>(const A& held) -> Answer {
        if constexpr (std::is_same_v<A, std::monostate>) {
          return none;
        } else {
          return use(held);
        }
      },
      shape);
}

/// use(shape), where there is one. `Held`: AnyShape, or a variant of fewer.
template <class Held> void with_shape(Held& held, const auto& use) {
  std::visit(
      [&]<class A>(A& shape) {
        if constexpr (!std::is_same_v<std::remove_const_t<A>, std::monostate>) use(shape);
      },
      held);
}

template <class Held> void move_shape(Held& held, const Vec3<double>& by) {
  with_shape(held, [&](auto& shape) { shape = moved(shape, by); });
}

/// Two bodies meet only if each belongs to a group that the other's mask has: (a.group & b.mask) and (b.group & a.mask).
struct Body {
  std::uint32_t id = 0;                          ///< no two bodies share one; decides every order
  std::string name;                              ///< empty: `body ID`
  AnyShape shape;                                ///< [m] where it is; std::monostate collides with nothing
  Vec3<double> velocity = Vec3<double>::Zero();  ///< [m/s] of the whole body; zero if it is static
  double mass = 1;                               ///< [kg] > 0; infinity: moves at its velocity, and nothing changes it
  bool is_static = false;                        ///< stays where it is, whatever its mass
  double restitution = 0;                        ///< [1] in [0, 1]; of two bodies in contact the larger one counts
  double gravity_scale = 1;                      ///< [1] times the world's gravity; of no effect without a finite mass
  std::uint32_t group = 1;                       ///< bits it belongs to
  std::uint32_t mask = ~std::uint32_t{0};        ///< bits it may meet
  bool turns = false;  ///< it spins, and contacts change how it does, unless its mass is infinite; an Aabb never does
  Vec3<double> angular_velocity = Vec3<double>::Zero();  ///< [rad/s] about its center; zero unless it turns
};

/// [1/kg] What an impulse does to it: 0 for a body that nothing moves.
inline double inverse_mass(const Body& body) { return body.is_static ? 0 : 1 / body.mass; }

/// True if its place can change in a step.
inline bool can_move(const Body& body) { return !body.is_static; }

/// [m] The point that its contact data is relative to; zero without a shape.
Vec3<double> position(const Body& body);

/// What complaints and the log call it: `bullet (id 3)`.
std::string called(const Body& body);

// ---- What a scene needs, decided from the scene alone. A plan omits only what it proves to yield nothing: with or without
// it every outcome is the same to the bit (docs/world.md says why, the tests show it).

/// One thing that a step might do.
struct PlanLine {
  std::string what;      ///< `static pairs`
  bool omitted = false;  ///< it is left out
  std::string why;       ///< the proof, or why it is needed, in numbers of the scene
};

struct Plan {
  bool full = false;             ///< nothing is omitted
  std::string broad_phase;       ///< its name
  bool sphere_aabb = false;      ///< the kernels of spheres and axis-aligned boxes alone
  bool all_bounds = false;       ///< every two bodies are asked, whatever their boxes
  bool static_pairs = false;     ///< pairs of two static bodies are asked, and what they find is dropped
  bool masked_pairs = false;     ///< the same for pairs that a mask leaves out
  bool resting_bounds = false;   ///< boxes and places of bodies that never move are computed anew in each step
  bool contacts = false;         ///< pairs are looked for at all
  bool events = false;           ///< begin, stay and end are kept, be it for nobody
  bool response = false;         ///< impulses are computed, be it to drop them
  bool spin = false;             ///< bodies are asked whether they turn
  bool spin_within_gap = false;  ///< those that do are asked with their spin, however far apart they stay without
  std::vector<PlanLine> lines;   ///< the same for people
};

/// Throws what World's constructor throws for the same scene.
Plan plan(std::span<const Body> bodies, const WorldOptions& options);

/// What a plan may omit: the `what` of its lines, in their order.
inline constexpr auto omission_names = std::to_array<std::string_view>(
    {"contacts", "events", "response", "broad phase", "pairs of disjoint boxes", "static pairs", "masked pairs",
     "motion of bodies at rest", "kernels of absent shapes"});
/// And after these, where bodies turn: a plan of what does not turn does not speak of it.
inline constexpr std::array<std::string_view, 2> spin_omission_names = {"spin", "spin short of the gap"};

/// What it omits, what it keeps, and why; ends with a newline.
std::string to_text(const Plan& plan);

// ---- What a step did and what it cost.

/// Two bodies in contact during a step.
struct Hit {
  std::uint32_t first = 0, second = 0;         ///< ids, first < second
  double time = 0;                             ///< [s] since the world began
  bool at_start = false;                       ///< in contact at the start of the step already
  Vec3<double> normal = Vec3<double>::Zero();  ///< unit, from first to second
  Vec3<double> point = Vec3<double>::Zero();   ///< [m] where they touch
};

/// [s] of wall clock, by phase.
struct PhaseSeconds {
  double integrate = 0;  ///< velocities and boxes
  double broad = 0;      ///< pairs whose boxes meet
  double narrow = 0;     ///< sweeps, or tests at an instant
  double response = 0;   ///< impulses, what they change later in the step, and the correction
  double events = 0;     ///< begin, stay, end; the listeners
  double total() const { return integrate + broad + narrow + response + events; }
};

/// The same in every run.
struct StepCounts {
  std::int64_t pairs = 0, sweeps = 0, gated = 0, hits = 0, impulses = 0, waiting = 0, pushed_through = 0;

  static constexpr auto fields() {
    using C = StepCounts;
    return record(
        sum("pairs", &C::pairs, "1", "Pairs whose boxes meet, as the broad phase found them; substeps add up."),
        sum("sweeps", &C::sweeps, "1", "Pairs that were asked, those after a hit included."),
        sum("gated", &C::gated, "1", "Of those, tested at an instant because both moved less than the gate."),
        sum("hits", &C::hits, "1", "Contacts, each with its time."),
        sum("impulses", &C::impulses, "1", "Impulses exchanged."),
        sum("waiting", &C::waiting, "1", "Bodies that stopped before the end of the step: clamped, or out of events."),
        sum("pushed_through", &C::pushed_through, "1",
            "Pairs of which a pose showed one in the other, and its response pushed it out the way it was going."));
  }
};

struct StepReport : StepCounts {
  std::uint64_t step = 0;  ///< 1 for the first
  double time = 0;         ///< [s] at its end
  std::size_t bytes = 0;   ///< [B] held for stepping, bodies not included
  PhaseSeconds seconds;
};

// ---- What no world can hold, by name.

/// [m] A coordinate beyond this has left the representable world: boxes and sweeps add up a few of them.
inline constexpr double end_of_the_world = std::numeric_limits<double>::max() / 1024;

/// True if the shape's fields are so small that a step's sums of them do not overflow. False for NaN.
bool is_in_the_world(const AnyShape& shape, const Vec3<double>& displacement);

/// Throws WorldError.
void require_valid(const Body& body);
void require_valid(const WorldOptions& options);

/// The same bodies in the order of ids. Throws WorldError.
std::vector<Body> checked_and_sorted(std::vector<Body> bodies);

/// Of numbers, to the bit. Source: the 64-bit FNV-1a hash, by words of 32 bits: its multiplication spreads what is low, not what is high.
class Digest {
 public:
  void add(std::uint32_t word) { hash_ = (hash_ ^ word) * 0x100000001b3; }
  void add(std::uint64_t words) {
    add(static_cast<std::uint32_t>(words));
    add(static_cast<std::uint32_t>(words >> 32));
  }
  void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }
  void add(const Vec3<double>& v) {
    for (int axis = 0; axis < 3; ++axis) add(v[axis]);
  }
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325;
};

// ---- Bodies that move, meet and bounce. docs/world.md says what a step does under each policy, and proves it bounded.
//
// Every order is that of the ids, whatever the order the bodies are given in, and no sum depends on how work is split:
// the same bodies and options give the same bits with any number of threads.

/// A body or an option that no world can hold; one line that names it and what is allowed.
struct WorldError : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// A body whose place or velocity no double holds any more; the world stays as it was before the step.
struct LeftTheWorld : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Two bodies that turn so far in a step that nothing can be proven of when they meet; the world stays as it was.
struct TurnsTooFar : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class Stepper;  // world/step.hpp

class World {
 public:
  /// Throws WorldError: two bodies with one id, a mass that is not > 0, a velocity, size or place that is not finite,
  /// axes that are not orthonormal, a static body with a velocity, an Aabb that turns, an option out of range. No bodies: a
  /// world where nothing happens. Bodies that overlap or lie in each other are in contact from the start, and are parted.
  World(std::vector<Body> bodies, WorldOptions options);
  ~World();
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;

  /// dt [s] > 0 and finite, or WorldError. Throws TooManyPairs, LeftTheWorld or TurnsTooFar, and then nothing has changed.
  const StepReport& step(double dt);

  const std::vector<Body>& bodies() const { return bodies_; }  ///< in the order of ids
  const Body* find(std::uint32_t id) const;                    ///< nothing if there is none
  double time() const { return time_; }                        ///< [s] since the world began
  const StepReport& report() const { return report_; }         ///< of the last step
  const std::vector<Hit>& hits() const { return hits_; }       ///< of the last step, in the order they were processed
  CollisionEvents& events() { return events_; }                ///< begin, stay, end; listeners
  const CollisionEvents& events() const { return events_; }
  const Plan& plan() const { return plan_; }
  const WorldOptions& options() const { return options_; }

  /// By hand, between two steps. Throw WorldError as the constructor does, and if there is no such body.
  void set_velocity(std::uint32_t id, const Vec3<double>& velocity);  ///< [m/s]
  void move(std::uint32_t id, const Vec3<double>& by);                ///< [m]
  void remove(std::uint32_t id);                                      ///< also from within a listener; its contacts end

  double energy() const;             ///< [J] kinetic, and of height, over bodies of finite mass; in the order of ids
  std::uint64_t state_hash() const;  ///< of every body's id, place and velocity, to the bit; of its turn, if it turns

 private:
  void commit(double dt);
  void tell(double start, double dt);
  std::size_t place_of(std::uint32_t id) const;
  template <class Change> void change(std::uint32_t id, const Change& by_hand);

  WorldOptions options_;
  std::vector<Body> bodies_;
  Plan plan_;
  std::unique_ptr<Stepper> stepper_;
  CollisionEvents events_;
  CollisionEvents unread_;  // what nobody reads, where nothing is omitted
  StepReport report_;
  std::vector<Hit> hits_;
  double time_ = 0;                 // [s]
  double since_ = 0, last_dt_ = 0;  // [s] the time is since + equal_steps * last_dt: adding up would drift
  std::uint64_t equal_steps_ = 0;
  bool changed_by_hand_ = true, stepping_ = false;
};

}  // namespace thinwall
