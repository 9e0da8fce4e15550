#include <thinwall/experiments/stiff_contact/tables.hpp>

#include <cmath>

#include <thinwall/experiments/stiff_contact/theory.hpp>

namespace thinwall {

namespace {

using enum ColumnType;

const Column scheme_column = {"scheme", text, "", "How a step is computed."};
const Column detection_column = {"detection", text, "", "discrete: at the poses; toi_split: at the time of impact."};
const Column stiffness_column = {"stiffness", number, "N/m", "Of the spring."};
const Column ratio_column = {"damping_ratio", number, "1", "damping / (2 sqrt(stiffness mass))."};
const Column step_column = {"step", number, "1/omega", "Time step, with omega = sqrt(stiffness / mass)."};

Value text_of(std::string_view name) { return std::string(name); }

/// [1] Deepest over what continuous time has.
double relative_depth(const StiffPlan& plan, const ContactLine& line) {
  const double omega = frequency(spring_of(plan.approach, line.contact));
  return line.tally.deepest * omega / (plan.approach.speed * deepest(line.contact.damping_ratio));
}

}  // namespace

Table stiff_tests_table(const std::vector<StiffTest>& tests) {
  Table table = {"self_test", "What theory claims, and how often it was wrong.", {}, {}, false, true};
  table.columns = {{"claim", text, "", "What must hold."},
                   {"judged", integer, "1", "Cells it speaks of."},
                   {"wrong", integer, "1", "Of those, in which it does not hold."},
                   {"passed", boolean, "", "None."}};
  for (const StiffTest& t : tests) table.rows.push_back({t.claim, t.judged, t.wrong, t.passed()});
  return table;
}

Table limits_table(const std::vector<LimitLine>& lines) {
  Table table = {
      "limits", "The largest stable step of a spring that holds both ways, measured and by formula.", {}, {}};
  table.columns = {scheme_column,
                   stiffness_column,
                   ratio_column,
                   {"limit", number, "1/omega", "By formula; missing where every step is stable."},
                   {"stable", number, "1/omega", "Measured: the state decays here (undamped: stays bounded)."},
                   {"unstable", number, "1/omega", "Measured: it grows here; missing if it grows at no step."},
                   {"inside", boolean, "", "The limit lies between the two."}};
  for (const LimitLine& l : lines) {
    table.rows.push_back({text_of(name(l.cell.scheme)), l.cell.stiffness, l.cell.ratio,
                          l.theory ? Value(*l.theory) : Value(), l.bracket.stable,
                          std::isfinite(l.bracket.unstable) ? Value(l.bracket.unstable) : Value(), l.holds_theory()});
  }
  return table;
}

Table stability_table(const StiffPlan& plan, const std::vector<LimitLine>& lines) {
  Table table = {"stability", "The map: what each step does to a spring that holds both ways.", {}, {}};
  table.columns = {
      scheme_column,
      stiffness_column,
      ratio_column,
      step_column,
      {"verdict", text, "", "Measured: stable, unstable, or undecided (inside the bracket of the limit)."},
      {"blow_up_step", integer, "1", "Steps after which the state is 2^32 times its start; missing if never."}};
  for (const LimitLine& l : lines) {
    for (std::size_t i = 0; i < plan.steps.size(); ++i) {
      table.rows.push_back({text_of(name(l.cell.scheme)), l.cell.stiffness, l.cell.ratio, plan.steps[i],
                            text_of(name(verdict_of(plan, l, i))), l.blow_ups[i] > 0 ? Value(l.blow_ups[i]) : Value()});
    }
  }
  return table;
}

Table bounces_table(const StiffPlan& plan, const std::vector<ContactLine>& lines) {
  Table table = {"bounces", "A wall that only pushes: every cell, over all phases.", {}, {}};
  table.columns = {scheme_column,
                   detection_column,
                   stiffness_column,
                   ratio_column,
                   step_column,
                   {"path", number, "m", "How far the ball flies in a step."},
                   {"bounces", integer, "1", "Asked, each at a phase of its own."},
                   {"returned", integer, "1", "Left on the side they came from."},
                   {"escaped", integer, "1", "Left on the other side: tunneled."},
                   {"unfinished", integer, "1", "Came to rest at the wall, or did not leave it."},
                   {"blown_up", integer, "1", "At some step faster than the settings' blow_up, however they ended."},
                   {"blow_up_step", integer, "1", "The first step after which one was; missing if none."},
                   {"speed_min", number, "1", "Of those that returned: the least speed out over speed in."},
                   {"speed_mean", number, "1", "The mean of it."},
                   {"speed_max", number, "1", "The greatest."},
                   {"energy_min", number, "1", "The least energy out over energy in."},
                   {"energy_max", number, "1", "The greatest."},
                   {"speed_exact", number, "1", "Speed out over speed in, in continuous time."},
                   {"speed_error", number, "1", "Root mean square of the difference to it."},
                   {"contact_steps", number, "1", "Mean number of steps that pushed."},
                   {"depth_max", number, "m", "Deepest of all, past the front face."},
                   {"depth_ratio", number, "1", "The same over the depth in continuous time."}};
  for (const ContactLine& l : lines) {
    const PenaltyContact& c = l.contact;
    const ContactTally& t = l.tally;
    const auto if_any = [&](double x) { return t.returned > 0 ? Value(x) : Value(); };
    table.rows.push_back({text_of(name(c.scheme)),
                          text_of(name(c.detection)),
                          c.stiffness,
                          c.damping_ratio,
                          c.step,
                          plan.approach.speed * seconds(plan.approach, c),
                          t.bounces(),
                          t.returned,
                          t.escaped,
                          t.unfinished,
                          t.blown_up,
                          t.blown_up > 0 ? Value(t.blow_up_step) : Value(),
                          if_any(t.slowest),
                          if_any(t.mean_speed()),
                          if_any(t.fastest),
                          if_any(t.slowest * t.slowest),
                          if_any(t.fastest * t.fastest),
                          restitution(c.damping_ratio),
                          if_any(t.rms_error()),
                          if_any(static_cast<double>(t.contact_steps) / static_cast<double>(t.returned)),
                          if_any(t.deepest),
                          if_any(relative_depth(plan, l))});
  }
  return table;
}

Table detection_table(const StiffPlan& plan, const std::vector<ContactLine>& lines) {
  Table table = {"detection",
                 "Contact found at the poses beside steps split at the time of impact, at the greatest stiffness.",
                 {},
                 {}};
  table.columns = {scheme_column,
                   ratio_column,
                   step_column,
                   {"error_discrete", number, "1", "Root mean square error of speed out over speed in: at the poses."},
                   {"error_split", number, "1", "The same with split steps."},
                   {"spread_discrete", number, "1", "Greatest less least speed out over speed in: at the poses."},
                   {"spread_split", number, "1", "The same with split steps."},
                   {"depth_discrete", number, "1", "Deepest over the depth in continuous time: at the poses."},
                   {"depth_split", number, "1", "The same with split steps."}};
  for (const ContactLine& l : lines) {
    const PenaltyContact& c = l.contact;
    if (c.detection != Detection::discrete || c.stiffness != plan.stiffest()) continue;
    const ContactLine* split = twin_of(lines, l);
    if (split == nullptr || !is_clean(plan, l) || !is_clean(plan, *split)) continue;
    table.rows.push_back({text_of(name(c.scheme)), c.damping_ratio, c.step, l.tally.rms_error(),
                          split->tally.rms_error(), l.tally.fastest - l.tally.slowest,
                          split->tally.fastest - split->tally.slowest, relative_depth(plan, l),
                          relative_depth(plan, *split)});
  }
  return table;
}

Table race_table(const StiffPlan& plan, const std::vector<StiffRacer>& racers) {
  Table table = {"race", "The error of a bounce against the number of its steps.", {}, {}};
  table.columns = {scheme_column,
                   detection_column,
                   ratio_column,
                   step_column,
                   {"returned", integer, "1", "Bounces that left on the side they came from."},
                   {"bounces", integer, "1", "Asked."},
                   {"speed_error", number, "1", "Root mean square error of speed out over speed in, over the phases."},
                   {"contact_steps", number, "1", "Mean number of steps that pushed."}};
  for (const StiffRacer& r : racers) {
    const auto if_any = [&](double x) { return r.tally.returned > 0 ? Value(x) : Value(); };
    table.rows.push_back({text_of(name(r.contact.scheme)), text_of(name(r.contact.detection)), r.contact.damping_ratio,
                          r.contact.step, r.tally.returned, plan.race_bounces, if_any(r.tally.rms_error()),
                          if_any(static_cast<double>(r.tally.contact_steps) / static_cast<double>(r.tally.returned))});
  }
  return table;
}

}  // namespace thinwall
