#include <thinwall/experiments/advise/advice.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <thinwall/experiments/lab/terminal.hpp>
#include <thinwall/experiments/models/shots.hpp>

namespace thinwall {

namespace {

/// `70 %`, `0`.
std::string in_percent(double chance) { return chance <= no_chance ? "0" : rounded_text(100 * chance, 3) + " %"; }

/// `no shot tunnels`, `1 % of the shots tunnel`.
std::string tunnel_words(double chance) {
  if (chance <= no_chance) return "no shot tunnels";
  if (chance == 1) return "every shot tunnels";
  return in_percent(chance) + " of the shots tunnel";
}

std::string angle_words(const Cell& cell) {
  return cell.angle_deg == 0 ? "head-on" : fmt::format("at {} deg from its normal", exact_text(cell.angle_deg));
}

/// [m] The path over which a rod touches the wall: where it lies flat, where it stands on end, and the mean over its angles.
struct RodContact {
  double flat, on_end, mean;
};
RodContact rod_contact(const Wish& wish) {
  const double flat = wish.cell.thickness + 2 * wish.cell.radius, core = wish.rod->length - 2 * wish.cell.radius;
  return {flat / cosine(wish.cell), (flat + core) / cosine(wish.cell),
          (flat + 2 / std::numbers::pi * core) / cosine(wish.cell)};
}

std::string rod_question_words(const Wish& wish) {
  const Cell& cell = wish.cell;
  const auto number = [](double x) { return rounded_text(x, 4); };
  const RodContact contact = rod_contact(wish);
  return wrapped(fmt::format(
             "A rod {} m long, end to end, and {} m in radius, that spins at {} deg/s, flies at {} m/s at a wall {} m thick, {}, {} "
             "steps a second.",
             exact_text(wish.rod->length), exact_text(cell.radius), exact_text(wish.rod->spin), exact_text(cell.speed),
             exact_text(cell.thickness), angle_words(cell), number(1 / cell.step))) +
         wrapped(fmt::format(
             "A step is {} s and {} m long, and the rod turns {} deg in it. It is in contact with the wall over {} m of "
             "the path where it lies flat to {} m where it stands on end, {} m on average.",
             number(cell.step), number(step_length(cell)), number(wish.rod->spin * cell.step), number(contact.flat),
             number(contact.on_end), number(contact.mean)));
}

/// Two sentences, a line each: what flies, and its measures.
std::string question_words(const Wish& wish) {
  if (wish.rod) return rod_question_words(wish);
  const Cell& cell = wish.cell;
  const auto number = [](double x) { return rounded_text(x, 4); };
  const std::string angle = angle_words(cell);
  std::string text = wrapped(fmt::format(
      "A ball of radius {} m flies at {} m/s at a wall {} m thick, {}, {} steps a second.", exact_text(cell.radius),
      exact_text(cell.speed), exact_text(cell.thickness), angle, number(1 / cell.step)));
  const double contact = slab_chord(cell);
  if (contact == 0) {
    return text + wrapped(
                      "A point and a wall of no thickness are in contact for an instant: every pose that is tested "
                      "misses it, and a method that wants to see the contact again at the time it found does so or not "
                      "as rounding has it.");
  }
  const double steps = contact / step_length(cell);
  return text + wrapped(fmt::format("A step is {} s and {} m long; of its path, {} m are in contact with the wall: {}.",
                                    number(cell.step), number(step_length(cell)), number(contact),
                                    steps < 1 ? in_percent(steps) + " of a step" : rounded_text(steps, 3) + " steps"));
}

/// `no shot tunnels, and ...`
std::string wanted_words(const Wish& wish) {
  std::string text = wish.miss == 0   ? "no shot tunnels"
                     : wish.miss == 1 ? "whatever: any number of shots may tunnel"
                                      : fmt::format("at most {} of the shots tunnel", in_percent(wish.miss));
  if (wish.late) text += fmt::format(", and none is seen more than {} m past first contact", exact_text(*wish.late));
  return text;
}

std::string seen(const AdviceRow& row) {
  const double latest = row.theory.largest_lateness().value_or(-1);
  if (latest < 0) return "how late it is seen has no formula";
  if (latest == 0) return "none is seen late";
  return fmt::format("none is seen more than {} m late", rounded_text(latest, 3));
}

/// The least, or as little as the measurement can tell.
std::string how_cheap(const Advice& advice) {
  const auto meeting = std::ranges::count_if(advice.rows, &AdviceRow::may_be_advised);
  const double own = advice.advised()->cost.dearer().value;
  const bool tied = std::ranges::any_of(
      advice.rows, [&](const AdviceRow& row) { return row.may_be_advised() && row.cost.dearer().value < own; });
  const char* const also = advice.wish.rod ? " without false hits" : "";
  if (meeting == 1) return fmt::format("no other method here meets the wish{}", also);
  return fmt::format("{} of the {} methods here that meet the wish{}", tied ? "as little as any" : "the least", meeting,
                     also);
}

/// Seen is not saved: docs/tunneling_theory.md.
std::string pushed_through(const Advice& advice) {
  const std::optional<double>& through = advice.advised()->theory.through;
  if (!through || *through <= advice.wish.miss + no_chance) return "";
  return fmt::format(" If a ball in the wall is pushed out the shorter way, {} go through, seen or not.",
                     in_percent(*through));
}

/// Of poses that a rod of exactly this spin does not get between.
std::string at_slower_spins(const Advice& advice) {
  const std::optional<double>& longest = advice.advised()->longest_step;
  if (!advice.wish.rod || (longest && *longest >= advice.wish.cell.step)) return "";
  return longest
             ? fmt::format(" At any slower spin it meets the wish up to steps of {} s.", rounded_down_text(*longest, 4))
             : " At some slower spin it meets the wish at no step.";
}

/// What would become of the simplest method.
std::string simplest(const Advice& advice) {
  const auto end = std::ranges::find_if(advice.rows, [](const AdviceRow& row) { return row.method.poses == 1; });
  if (end == advice.rows.end() || end->meets) return "";
  if (!end->longest_step) return " Testing only the end of each step would not do at any step.";
  const double longest = *end->longest_step;
  if (longest > 0.5) {
    return fmt::format(" Testing only the end of each step would do at steps of {} s and less.",
                       rounded_down_text(longest, 4));
  }
  return fmt::format(" Testing only the end of each step would do from {} steps a second on.",
                     longest > 1e-12 ? grouped_text(std::llround(std::ceil(1 / longest))) : exact_text(1 / longest));
}

constexpr const char* limits =
    "Holds for one infinite wall at rest, straight flight without rotation, and a first contact that is anywhere in its "
    "step alike. At a wall that ends, a ray from the center misses what only the rim meets, and tested poses are "
    "never safe.";

constexpr const char* rod_limits =
    "Holds for one infinite wall at rest, straight flight, a rod that spins at a constant rate about an axis in the plane of the "
    "wall, and a first contact that is anywhere in its step, and of a rod at any angle, alike. The longest step does at its "
    "spin and any slower one. Linear sweeps join across such a wall; past a post, or at a rim, they are as blind as a tested pose. False hits are in steps by "
    "whose end nothing touches: thinwall run spinning_rod counts them.";

constexpr const char* header =
    "                           chance of  seen late by up to  time a step [ns]          longest step\n"
    "  method                   tunneling  [m]       [steps]   clear        contact      that does\n";

/// A median with as many decimals as its interval bears out.
std::string time_text(const Measured& time) {
  const double half = std::max(time.interval.upper - time.value, time.value - time.interval.lower);
  if (half > 9.9) return fmt::format("{:.0f} +-{:.0f}", time.value, std::ceil(half));
  return fmt::format("{:.1f} +-{:.1f}", time.value, std::max(0.1, std::ceil(10 * half) / 10));
}

std::string step_text(const std::optional<double>& step) {
  if (!step) return "none";
  return *step == allowed_step.upper ? "any" : rounded_down_text(*step, 4);
}

/// Poses may do at the wish's spin and step and not at every slower spin.
bool does_at_its_spin_alone(const AdviceRow& row, const Wish& wish) {
  return row.meets && row.longest_step.value_or(0) < wish.cell.step;
}

/// Of a method: how late it is seen, in m and in steps, and the longest step that does.
using RowNumbers = std::array<std::string, 3>;

RowNumbers numbers_of(const AdviceRow& row, const Wish& wish) {
  const bool never_seen = row.theory.probability == 1;
  const std::optional<double> latest = never_seen ? std::nullopt : row.theory.largest_lateness();
  return {latest ? rounded_text(*latest, 3) : "-", latest ? rounded_text(*latest / step_length(wish.cell), 3) : "-",
          step_text(row.longest_step)};
}

std::string row_text(const AdviceRow& row, const RowNumbers& numbers, const char* mark, const Wish& wish) {
  const std::optional<double>& chance = row.theory.probability;
  return fmt::format("{} {:<24} {:<10} {:<9} {:<9} {:<12} {:<12} {}{}{}\n", mark, row.method.name,
                     chance ? in_percent(*chance) : "-", numbers[0], numbers[1], time_text(row.cost.clear),
                     time_text(row.cost.contact), numbers[2], numbers[2].front() <= '9' ? " s" : "",
                     does_at_its_spin_alone(row, wish) ? " *" : "");
}

std::string table_text(const Advice& advice) {
  std::string text = header;
  bool met = true, truly = true;
  std::vector<RowNumbers> numbers;
  for (const AdviceRow& row : advice.rows) numbers.push_back(numbers_of(row, advice.wish));
  for (std::size_t k = 0; k < std::tuple_size_v<RowNumbers>; ++k) {
    std::vector<std::string*> column;
    for (RowNumbers& row : numbers) column.push_back(&row[k]);
    in_one_notation(column);
  }
  for (std::size_t i = 0; i < advice.rows.size(); ++i) {
    const AdviceRow& row = advice.rows[i];
    if (truly && row.meets && !row.may_be_advised()) text += "These meet it too, with false hits:\n";
    if (met && !row.meets) text += "These do not meet the wish at this step:\n";
    met = row.meets;
    truly = row.may_be_advised();
    text += row_text(row, numbers[i], &row == advice.advised() ? ">" : " ", advice.wish);
  }
  if (std::ranges::any_of(advice.rows, [&](const AdviceRow& row) { return does_at_its_spin_alone(row, advice.wish); }))
    text += "* At this spin it meets the wish at this step; at every slower spin, at the step given.\n";
  return text;
}

/// One line for all numbers of poses.
std::string formulas_text(const Advice& advice) {
  std::vector<std::string> lines;
  for (const AdviceRow& row : advice.rows) {
    const std::string name = row.method.poses > 1 ? "substeps_n" : row.method.name;
    const bool known = row.theory.probability.has_value();
    const std::string line = fmt::format("  {:<26}{:<41}{}\n", name, known ? row.theory.why : "no formula",
                                         known ? row.theory.why_late : "no formula");
    if (std::ranges::find(lines, line) == lines.end()) lines.push_back(line);
  }
  std::string text =
      advice.wish.rod
          ? "Formulas: v speed, h step, n poses a step, a angle, b = w + 2r (thickness, radius), c length of the core;\n"
            "m = max(|cos(D/2) cos p|, |sin(D/2) sin p|), D turned from pose to pose, E mean over p: docs/spinning_rod.md.\n"
          : "Formulas: v speed, h step, n poses a step, w thickness, r radius, a angle: docs/tunneling_theory.md.\n";
  text += "  method                    chance of tunneling                      seen late by up to [m]\n";
  for (const std::string& line : lines) text += line;
  return text;
}

using nlohmann::ordered_json;

ordered_json optional_number(const std::optional<double>& number) {
  return number ? ordered_json(*number) : ordered_json();
}

ordered_json time_json(const Measured& time) {
  return {{"median", time.value}, {"lower", time.interval.lower}, {"upper", time.interval.upper}};
}

ordered_json row_json(const AdviceRow& row, double step_length) {
  const std::optional<double>& chance = row.theory.probability;
  const std::optional<double> latest = row.theory.largest_lateness();
  return {{"method", row.method.name},
          {"meets", row.meets},
          {"chance", optional_number(chance)},
          {"chance_formula", chance ? ordered_json(row.theory.why) : ordered_json()},
          {"latest_m", optional_number(latest)},
          {"latest_steps", latest ? ordered_json(*latest / step_length) : ordered_json()},
          {"latest_formula", latest ? ordered_json(row.theory.why_late) : ordered_json()},
          {"longest_step_s", optional_number(row.longest_step)},
          {"clear_ns", time_json(row.cost.clear)},
          {"contact_ns", time_json(row.cost.contact)},
          {"false_hits", row.method.hits_falsely},
          {"in_experiment", row.method.fired}};
}

/// Enough to see a chance as small as the wish's 100 times; 1e5 otherwise.
std::int64_t shots_for(double miss) {
  constexpr double least = 1e5, most = 1e7;
  return miss > 0 ? std::llround(std::clamp(100 / miss, least, most)) : std::llround(least);
}

std::string expectations(const Wish& wish, std::span<const Candidate> candidates) {
  std::string text;
  for (const Candidate& candidate : candidates) {
    if (!candidate.fired) continue;
    const Theory theory = candidate.theory(wish.cell);
    const auto latest = theory.largest_lateness();
    text += fmt::format("#   {:<26}{:<12}{:<14}{}\n", candidate.name,
                        theory.probability ? in_percent(*theory.probability) : "no formula",
                        latest ? rounded_text(*latest, 3) + " m" : "-", meets_wish(wish, theory) ? "yes" : "no");
  }
  return text;
}

}  // namespace

std::string rounded_down_text(double value, int digits) {
  const double near = std::stod(rounded_text(value, digits));
  const double unit = std::pow(10.0, std::floor(std::log10(value)) + 1 - digits);
  return rounded_text(near <= value ? near : near - unit, digits);
}

std::string advice_sentence(const Advice& advice) {
  const AdviceRow* best = advice.advised();
  if (best == nullptr) return "No method here meets the wish at this step.";
  return fmt::format("Use {}: {}, {}, and a step takes {} ns, {}.{}{}{}", best->method.name,
                     tunnel_words(best->theory.probability.value_or(0)), seen(*best),
                     rounded_text(best->cost.dearer().value, 3), how_cheap(advice), pushed_through(advice),
                     at_slower_spins(advice), simplest(advice));
}

std::string advice_text(const Advice& advice) {
  return question_words(advice.wish) + wrapped("Wanted: " + wanted_words(advice.wish) + ".") + "\n" +
         wrapped(advice_sentence(advice)) + "\n" + table_text(advice) +
         wrapped(
             "A clear step ends before the wall, in the next is contact; a query of each, on this machine: the median and a "
             "95 % interval. A method counts by the dearer of the two.") +
         "\n" + formulas_text(advice) + "\n" + wrapped(advice.wish.rod ? rod_limits : limits);
}

ordered_json advice_json(const Advice& advice) {
  const Cell& cell = advice.wish.cell;
  ordered_json json = {
      {"speed_m_s", cell.speed},       {"radius_m", cell.radius},  {"thickness_m", cell.thickness},
      {"angle_deg", cell.angle_deg},   {"step_s", cell.step},      {"step_m", step_length(cell)},
      {"contact_m", slab_chord(cell)}, {"miss", advice.wish.miss}, {"late_m", optional_number(advice.wish.late)}};
  if (advice.wish.rod) {
    json["contact_m"] = rod_contact(advice.wish).mean;
    json["length_m"] = advice.wish.rod->length;
    json["spin_deg_s"] = advice.wish.rod->spin;
  }
  const AdviceRow* best = advice.advised();
  json["method"] = best == nullptr ? ordered_json() : ordered_json(best->method.name);
  json["advice"] = advice_sentence(advice);
  json["methods"] = ordered_json::array();
  for (const AdviceRow& row : advice.rows) json["methods"].push_back(row_json(row, step_length(cell)));
  return json;
}

std::string config_text(const Wish& wish, std::span<const Candidate> candidates) {
  const Cell& cell = wish.cell;
  std::vector<std::string> methods;
  for (const std::string_view name : method_names()) methods.push_back(fmt::format("\"{}\"", name));
  std::string text = fmt::format(
      "{}\n#\n# Wanted: {}.\n# Expected:                   tunnel      seen late by  meets the wish\n{}"
      "# Every run fires the bullet of the textbook as well.\n"
      "experiment = \"thin_wall\"\nshots = {}\n\nspeed = [{}]  # [m/s]\nstep = [{}]  # [s]\n"
      "angle_deg = [{}]  # [deg]\nradius = [{}]  # [m]\nthickness = [{}]  # [m]\nwall = [\"infinite\"]\n\n",
      check_config_title, wanted_words(wish), expectations(wish, candidates), shots_for(wish.miss),
      exact_text(cell.speed), exact_text(cell.step), exact_text(cell.angle_deg), exact_text(cell.radius),
      exact_text(cell.thickness));
  text += fmt::format("method = [{}]\nsubsteps = [{}]  # poses a step\nscalar = [\"double\"]\n",
                      fmt::join(methods, ", "), fmt::join(offered_poses(wish), ", "));
  return text;
}

}  // namespace thinwall
