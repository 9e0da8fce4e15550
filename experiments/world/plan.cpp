#include <thinwall/experiments/world/world.hpp>

#include <algorithm>
#include <array>

#include <thinwall/experiments/world/pairs.hpp>

namespace thinwall {
namespace {

constexpr std::size_t half_loop_until = 128;  ///< bodies with a shape; measured by bench/world
constexpr std::string_view best_of_many = "uniform_grid";

/// What a scene is made of, as far as a plan looks.
struct Census {
  std::size_t with_shape = 0, at_rest = 0, movers = 0;
  std::size_t spinning = 0, spinning_balls = 0;
  std::array<std::size_t, std::variant_size_v<AnyShape>> shapes{};
  bool masks = false;
};

Census census_of(std::span<const Body> bodies) {
  Census census;
  std::uint32_t groups = 0, masks = ~std::uint32_t{0};
  for (const Body& body : bodies) {
    ++census.shapes[body.shape.index()];
    if (std::holds_alternative<std::monostate>(body.shape)) continue;
    ++census.with_shape;
    ++(can_move(body) ? census.movers : census.at_rest);
    if (body.turns && can_move(body)) ++(can_turn(body) ? census.spinning : census.spinning_balls);
    groups |= body.group;
    masks &= body.mask;
    if (body.group == 0) census.masks = true;
  }
  census.masks = census.masks || (groups & ~masks) != 0;
  return census;
}

std::string of(std::size_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

bool contains(const std::vector<std::string>& list, std::string_view wanted) {
  return std::find(list.begin(), list.end(), wanted) != list.end();
}

std::string pairs_of(std::size_t n) { return of(n * (n - (n > 0 ? 1 : 0)) / 2, "pair", "pairs"); }

}  // namespace

Plan plan(std::span<const Body> bodies, const WorldOptions& options) {
  require_valid(options);
  checked_and_sorted({bodies.begin(), bodies.end()});
  const Census census = census_of(bodies);
  const bool full = options.full_plan, swept = sweeps(options.policy);
  Plan plan;
  plan.full = full;
  const auto line = [&](const std::string& what, bool could_go, const std::string& if_gone, const std::string& if_not) {
    const bool goes = could_go && !full && !contains(options.keep, what);
    plan.lines.push_back({what, goes, !could_go ? if_not : goes ? if_gone : "could go: " + if_gone});
    return !goes;
  };
  // True if it is done though it could go.
  const auto kept = [&](const std::string& what, bool could_go, const std::string& if_gone, const std::string& if_not) {
    return line(what, could_go, if_gone, if_not) && could_go;
  };

  const bool asked_for = options.response || options.events;
  plan.contacts = line("contacts", !asked_for, "nobody reads events, and no response is asked for",
                       options.response ? "the response needs them" : "the events are read");
  plan.events = line("events", !options.events, "nobody reads them", "they are read");
  plan.response = line("response", !options.response, "not asked for: every path is straight", "asked for");

  const bool is_small = census.with_shape <= half_loop_until;
  const std::string by_auto(is_small && !contains(options.keep, "broad phase") ? "all_pairs" : best_of_many);
  plan.broad_phase = options.broad_phase == "auto" ? by_auto : options.broad_phase;
  line("broad phase", plan.broad_phase == "all_pairs" || (is_small && options.broad_phase == "auto"),
       of(census.with_shape, "shape", "shapes") + ": the half loop over boxes is cheaper than to sort them",
       plan.broad_phase + (options.broad_phase == "auto" ? ", as there are " : ", as asked for; there are ") +
           of(census.with_shape, "shape", "shapes"));
  plan.all_bounds = kept(
      "pairs of disjoint boxes", census.with_shape > 1,
      std::string("a body stays in its ") + (swept ? "swept box" : "box") + ": if two are disjoint, so are the bodies",
      "there is no pair");
  plan.static_pairs = kept("static pairs", census.at_rest > 1, pairs_of(census.at_rest) + " of bodies that never move",
                           "fewer than two static bodies");
  plan.masked_pairs = kept("masked pairs", census.masks, "a mask leaves out a group that is there",
                           "every mask has every group that is there");
  plan.resting_bounds =
      kept("motion of bodies at rest", census.at_rest > 0,
           "the boxes of " + of(census.at_rest, "static body", "static bodies") + " stay from step to step",
           "every body can move");

  const bool only_two = census.shapes[3] + census.shapes[4] == 0;
  plan.sphere_aabb = !line("kernels of absent shapes", only_two, "spheres and axis-aligned boxes alone",
                           "there are oriented boxes or capsules");
  if (census.spinning + census.spinning_balls == 0) return plan;  // nothing turns: no question
  plan.spin = line("spin", census.spinning == 0,
                   of(census.spinning_balls, "ball looks", "balls look") + " the same whichever way up",
                   of(census.spinning, "body turns", "bodies turn"));
  plan.spin_within_gap =
      line("spin short of the gap", census.spinning > 0,
           "asked without it, at the distance that it can bridge: who stays farther apart never meets",
           "no body turns for anyone to see");
  return plan;
}

std::string to_text(const Plan& plan) {
  std::size_t width = 0;
  for (const PlanLine& line : plan.lines) width = std::max(width, line.what.size());
  std::string text = plan.full ? "plan: full, nothing is omitted\n" : "plan\n";
  for (const PlanLine& line : plan.lines) {
    text += std::string("  ") + (line.omitted ? "omit  " : "keep  ") + line.what +
            std::string(width + 2 - line.what.size(), ' ') + line.why + "\n";
  }
  return text;
}

}  // namespace thinwall
