/// See docs/stiff_contact.md.
#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include <thinwall/experiments/experiment_list.hpp>
#include <thinwall/experiments/lab/columns.hpp>
#include <thinwall/experiments/lab/plot.hpp>
#include <thinwall/experiments/lab/race.hpp>
#include <thinwall/experiments/lab/terminal.hpp>
#include <thinwall/experiments/lab/text.hpp>
#include <thinwall/experiments/stiff_contact/model.hpp>
#include <thinwall_embedded.hpp>

namespace thinwall {

namespace {

using Row = ContactRow;

template <class T> bool is_in(const std::vector<T>& all, const T& x) { return std::ranges::find(all, x) != all.end(); }

bool has_returned(const Row& row) { return row.tally.returned > 0; }
bool all_returned(const Row& row) { return has_returned(row) && row.tally.returned == row.tally.bounces(); }
std::int64_t bounces_of(const Row& row) { return row.tally.bounces(); }
double rms_error(const Row& row) { return row.tally.rms_error(); }
double spread(const Row& row) { return row.tally.fastest - row.tally.slowest; }
double mean_speed(const Row& row) { return row.tally.mean_speed(); }
double ratio_of(const Row& row) { return row.contact.spring.damping_ratio; }
std::string method_of(const Row& row) {
  return fmt::format("{} {}", name(row.contact.spring.scheme), name(row.contact.detection));
}

/// [1] Deepest over what continuous time has.
double relative_depth(const StiffPlan& plan, const Row& row) {
  return row.tally.deepest * frequency(plan.approach, row.contact) / (plan.approach.speed * deepest(ratio_of(row)));
}

// Who is cheapest at which error.

/// [ns] A bounce.
Measured time_of(const Row& row) { return median_of_rounds(row.nanoseconds); }

/// Of each damping ratio, scheme and detection the cheapest whose error is at most this, if there is one.
std::vector<Row> cheapest(const std::vector<Row>& racers, double error) {
  const auto good = only(racers, [&](const Row& r) { return all_returned(r) && rms_error(r) <= error; });
  std::vector<Row> best;
  for (const Group<Row>& group : group_by(good, [](const Row& r) { return std::pair(ratio_of(r), method_of(r)); }))
    best.push_back(**std::ranges::min_element(group, {}, [](const Row* r) { return time_of(*r).value; }));
  return best;
}

// What the tables show.

/// In this order.
auto contact_columns(auto... names) { return together(fields(&Row::contact, {names})...); }

auto error_column() {
  return where(has_returned,
               value("speed_error", "1", "Root mean square error of speed out over speed in.", rms_error));
}

auto contact_steps_column() {
  return where(has_returned, value("contact_steps", "1", "Mean number of steps that pushed.", [](const Row& r) {
                 return static_cast<double>(r.tally.contact_steps) / static_cast<double>(r.tally.returned);
               }));
}

Table claims_table(const std::vector<StiffClaim>& claims) {
  using C = StiffClaim;
  return in_report(table("self_test", "What theory claims, and how often it was wrong.", claims,
                         text("claim", "What must hold.", &C::text),
                         value("judged", "1", "Cells it speaks of.", &C::judged),
                         value("wrong", "1", "Of those, in which it does not hold.", &C::wrong),
                         value("passed", "", "None.", &C::passed)));
}

Table limits_table(const std::vector<LimitRow>& rows) {
  return table("limits", "The largest stable step of a spring that holds both ways, measured and by formula.", rows,
               fields(std::identity()),
               value("inside", "", "The limit lies between the two.", &LimitRow::holds_theory));
}

Table bounces_table(const StiffPlan& plan, const std::vector<Row>& rows) {
  const auto of_returned = columns_of<Row>(
      value("speed_mean", "1", "The mean of it.", mean_speed), fields(&Row::tally, {"speed_max"}),
      value("energy_min", "1", "The least energy out over energy in.",
            [](const Row& r) { return r.tally.slowest * r.tally.slowest; }),
      value("energy_max", "1", "The greatest.", [](const Row& r) { return r.tally.fastest * r.tally.fastest; }));
  return table("bounces", "A wall that only pushes: every cell, over all phases.", rows,
               contact_columns("scheme", "detection", "stiffness", "damping_ratio", "step"),
               value("path", "m", "How far the ball flies in a step.",
                     [&](const Row& r) { return step_path(plan.approach, r.contact); }),
               value("bounces", "1", "Asked, each at a phase of its own.", bounces_of),
               fields(&Row::tally, {"returned", "escaped", "unfinished", "blown_up", "blow_up_step", "speed_min"}),
               where(has_returned, of_returned),
               value("speed_exact", "1", "Speed out over speed in, in continuous time.",
                     [](const Row& r) { return restitution(ratio_of(r)); }),
               error_column(), contact_steps_column(), fields(&Row::tally, {"depth_max"}),
               where(has_returned, value("depth_ratio", "1", "The same over the depth in continuous time.",
                                         [&](const Row& r) { return relative_depth(plan, r); })));
}

/// Discrete detection beside split steps, at the greatest stiffness, where every bounce came back.
Table detection_table(const StiffResults& results) {
  const StiffPlan& plan = results.plan;
  const auto split = [&](const Row& r) -> const Row& { return twin_of(results.bounces, r); };
  const auto rows = only(results.bounces, [&](const Row& r) {
    return r.contact.detection == Detection::discrete && r.contact.spring.stiffness == plan.stiffest() &&
           is_clean(plan, r) && is_clean(plan, split(r));
  });
  const auto both = [&](const std::string& what, const std::string& description, const auto& read) {
    return columns_of<Row>(value(what + "_discrete", "1", description + ": at the poses.", read),
                           value(what + "_split", "1", "The same with split steps.",
                                 [read, split](const Row& r) { return read(split(r)); }));
  };
  return table("detection",
               "Contact found at the poses beside steps split at the time of impact, at the greatest stiffness.", rows,
               contact_columns("scheme", "damping_ratio", "step"),
               both("error", "Root mean square error of speed out over speed in", rms_error),
               both("spread", "Greatest less least speed out over speed in", spread),
               both("depth", "Deepest over the depth in continuous time",
                    [&](const Row& r) { return relative_depth(plan, r); }));
}

auto racer_columns() { return contact_columns("scheme", "detection", "damping_ratio", "step"); }

Table times_table(const std::vector<Row>& racers) {
  return timing(
      table("timings", "Time a bounce, on this machine, the threads of the run at work: medians over rounds.", racers,
            racer_columns(), error_column(),
            value("bounce_ns", "ns", "Median time of a bounce, from before contact until it is seen to leave.",
                  of(time_of, &Measured::value)),
            value("lower_ns", "ns", "Lower end of its 95 % bootstrap interval.",
                  [](const Row& r) { return time_of(r).interval.lower; }),
            value("upper_ns", "ns", "Upper end of it.", [](const Row& r) { return time_of(r).interval.upper; })));
}

// What the pictures show.

std::string fate_of(const Row& row) {
  const ContactTally& t = row.tally;
  if (t.escaped > 0) return t.escaped == t.bounces() ? "all get through" : "some get through";
  return t.blown_up > 0 ? "all return, some too fast" : "all return";
}

bool is_positive(double x) { return x > 0; }

/// Against the step, both axes logarithmic. What is 0 has no place there, or that of the least that is drawn.
Plot plot_of(const StiffPlan& plan, const std::vector<Row>& rows, const char* y, std::string y_label) {
  const auto speed = [](const Row& r) {
    const auto drawn = [](double ratio) { return std::max(1e-3, ratio); };
    return Measured{drawn(mean_speed(r)), {drawn(r.tally.slowest), drawn(r.tally.fastest)}};
  };
  return plot(rows, fields(&Row::contact), text("method", "", method_of), text("fate", "", fate_of),
              measured("speed", "", "", speed, "speed_"), value("error", "", "", rms_error),
              value("spread", "", "", [](const Row& r) { return std::max(1e-5, spread(r)); }),
              value("depth", "", "", [&](const Row& r) { return relative_depth(plan, r); }),
              where([](const Row& r) { return !r.nanoseconds.empty(); }, measured("time", "", "", time_of, "time_")))
      .where(y, is_positive)
      .x("step", Axis::log, "h omega [1]")
      .y(y, Axis::log, std::move(y_label))
      .by("method")
      .height(0.9);
}

/// The headline: measured and predicted limits of a spring that holds both ways.
Figure stability_figure(const StiffResults& results) {
  const StiffPlan& plan = results.plan;
  Figure figure = {.name = "stability",
                   .title = "Which steps a spring and damper can take",
                   .caption = fmt::format(
                       "Circles and squares: what the steps of the map do, at {:g} N/m. Triangles: the measured limit "
                       "at every stiffness from {:g} to {:g} N/m, with bars thinner than the line.",
                       plan.stiffness.front(), plan.stiffness.front(), plan.stiffest())};
  const auto fate = [](const MapStep& s) { return s.verdict == "stable" ? "decays" : "grows"; };
  const auto middle = [](const LimitRow& r) {
    return Measured{std::sqrt(r.stable * r.unstable), {r.stable, r.unstable}};
  };
  const auto decided = only(flat(results.limits, &LimitRow::map), [&](const MapStep& s) {
    return s.spring.stiffness == plan.stiffness.front() && s.verdict != "undecided";
  });
  for (const Scheme scheme : all_schemes) {
    const std::string scheme_name(name(scheme));
    const auto against_ratio = [&](Plot points) {
      return points.where("scheme", scheme_name)
          .where("damping_ratio", is_positive)  // 0 has no place on the axis
          .x("damping_ratio", Axis::log, "damping ratio zeta [1]");
    };
    Panel panel = against_ratio(plot(results.limits, fields(std::identity()), measured("middle", "", "", middle)))
                      .y("middle", Axis::log, "h omega [1], " + scheme_name)
                      .label("measured limit, every stiffness")
                      .height(0.9)
                      .curve("formula", [scheme](double ratio) { return *step_limit(scheme, ratio); });
    const Panel tried =
        against_ratio(plot(decided, fields(std::identity()), text("fate", "", fate))).y("step").by("fate");
    panel.series.insert(panel.series.begin(), tried.series.begin(), tried.series.end());
    figure.panels.push_back(panel);
  }
  return figure;
}

/// At the greatest stiffness, and at steps at which a bounce is no matter of chance.
std::vector<Row> clean_rows(const StiffResults& results) {
  constexpr double last_step = 3;  // [1] h omega
  return only(results.bounces, [&](const Row& r) {
    return r.contact.spring.stiffness == results.plan.stiffest() && r.contact.step <= last_step &&
           is_clean(results.plan, r);
  });
}

Figure bounce_figure(const StiffResults& results) {
  constexpr double last_bound = 1.99;  // they end at 0 and infinity
  const StiffPlan& plan = results.plan;
  Figure figure = {
      .name = "bounce",
      .title = "What one bounce off a wall that only pushes does to the speed",
      .caption = fmt::format("Contact found at the poses, {:g} N/m. Points: the mean over the phases; bars: from "
                             "the least to the greatest.",
                             plan.stiffest())};
  std::vector<Row> rows = clean_rows(results);
  std::ranges::stable_sort(rows, std::greater<>(), ratio_of);  // the least damped on top
  for (const Scheme scheme : all_schemes) {
    const std::string scheme_name(name(scheme));
    Plot panel = plot_of(plan, rows, "speed", "speed out / in [1], " + scheme_name)
                     .where("detection", "discrete")
                     .where("scheme", scheme_name)
                     .by("damping_ratio");
    for (const double ratio : plan.bounce_ratios) panel.level("continuous time", restitution(ratio));
    for (double Interval::*end : {&Interval::lower, &Interval::upper}) {
      if (scheme != Scheme::semi_implicit || plan.bounce_ratios.front() != 0) continue;
      const auto end_at = [=](double step) { return *bounce_bounds(std::min(step, last_bound)).*end; };
      panel.curve("bounds, undamped", end_at, plan.bounce_steps.front(), last_bound);
    }
    figure.panels.push_back(panel);
  }
  return figure;
}

Figure escape_figure(const StiffResults& results) {
  const StiffPlan& plan = results.plan;
  const Approach& e = plan.approach;
  const double ratio = plan.bounce_ratios.front(), rate = e.speed / e.reach();
  const auto at = [&](double step) { return e.mass * (step * rate) * (step * rate); };  // [N/m]
  const auto step_at = [&](double stiffness) { return std::sqrt(stiffness / e.mass) / rate; };
  Figure figure = {
      .name = "escape",
      .title = "Who gets through the wall",
      .caption = fmt::format("{:g} m/s, {:g} kg, radius {:g} m, a wall of {:g} m, damping ratio {:g}. Too fast: "
                             "more than {:g} times the incoming speed.",
                             e.speed, e.mass, e.radius, e.thickness, ratio, e.blow_up)};
  for (const std::string scheme : {"semi_implicit", "implicit_euler"}) {
    for (const std::string detection : {"discrete", "toi_split"}) {
      figure.panels.push_back(
          plot_of(plan, results.bounces, "stiffness",
                  fmt::format("stiffness [N/m], {} {}", scheme == "implicit_euler" ? "implicit" : "semi-impl.",
                              detection == "discrete" ? "discrete" : "split"))
              .where("scheme", scheme)
              .where("detection", detection)
              .where("damping_ratio", ratio)
              .by("fate")
              .height(0.75)
              .curve("a step goes to the wall's middle", at,
                     std::max(step_at(plan.stiffness.front()), plan.bounce_steps.front()),
                     std::min(step_at(plan.stiffest()), plan.bounce_steps.back()))
              .level("too soft in continuous time", at(deepest(ratio))));
    }
  }
  return figure;
}

/// What splitting the step changes, at the middle one of the damping ratios.
Figure detection_figure(const StiffResults& results) {
  const StiffPlan& plan = results.plan;
  const double ratio = plan.bounce_ratios[plan.bounce_ratios.size() / 2];
  const auto rows = only(clean_rows(results), [&](const Row& r) { return ratio_of(r) == ratio; });
  return {.name = "detection",
          .title = "Contact found at the poses, and steps split at the time of impact",
          .caption = fmt::format("Damping ratio {:g}, {:g} N/m. Above what depends on the phase, in the middle the "
                                 "root mean square against continuous time, below the greatest depth.",
                                 ratio, plan.stiffest()),
          .panels = {joined(plot_of(plan, rows, "spread", "speed ratio, greatest - least [1]")),
                     joined(plot_of(plan, rows, "error", "speed ratio, error [1]")),
                     joined(plot_of(plan, rows, "depth", "depth / depth in continuous time [1]"))}};
}

Figure race_figure(const StiffResults& results) {
  const StiffPlan& plan = results.plan;
  Figure figure = {
      .name = "race",
      .title = "Error of a bounce against run time",
      .caption = fmt::format("From the roughest step to the finest, {:g} N/m, where all bounces come back. Bars, "
                             "mostly hidden by their points: 95 % bootstrap intervals of the median.",
                             plan.stiffest()),
      .is_timing = true};
  for (const double ratio : plan.bounce_ratios) {
    figure.panels.push_back(joined(
        plot_of(plan, only(results.racers, all_returned), "time", fmt::format("ns a bounce, damping ratio {:g}", ratio))
            .where("damping_ratio", ratio)
            .where("error", is_positive)
            .x("error", Axis::log, "root mean square error of speed out over speed in [1]")));
  }
  return figure;
}

// What it says.

/// Undamped (or least damped), at the greatest stiffness, at the poses: at up to four of the steps below 2, or at the last of them.
std::vector<Row> told_rows(const StiffResults& results) {
  const StiffPlan& plan = results.plan;
  auto steps = only(std::vector{0.1, 0.3, 1.5, 1.9}, [&](double step) { return is_in(plan.bounce_steps, step); });
  const auto last = std::ranges::lower_bound(plan.bounce_steps, 2.0);
  if (steps.empty() && last != plan.bounce_steps.begin()) steps.push_back(*std::prev(last));
  return only(results.bounces, [&](const Row& r) {
    return r.contact.spring.stiffness == plan.stiffest() && r.contact.detection == Detection::discrete &&
           ratio_of(r) == plan.bounce_ratios.front() && is_in(steps, r.contact.step);
  });
}

/// Bounces off walls that would hold in continuous time, where the ball stays this side of the middle, by scheme and detection, over the rows of
/// the damping ratios.
std::vector<Row> passages(const StiffResults& results, const std::vector<double>& ratios) {
  const Approach& e = results.plan.approach;
  const auto stiff = only(results.bounces, [&](const Row& r) {
    return is_in(ratios, ratio_of(r)) && e.speed * deepest(ratio_of(r)) / frequency(e, r.contact) < e.reach();
  });
  std::vector<Row> sums;
  for (const Group<Row>& group : group_by(stiff, method_of))
    sums.push_back({group[0]->contact, total_of(group, &Row::tally)});
  return sums;
}

std::string stiff_answer(const StiffResults& results) {
  std::string text = fmt::format(
      "A spring that holds both ways is stable below 2 (sqrt(1 + zeta^2) - zeta) / omega a step with semi-implicit Euler, below "
      "2 zeta / omega (2 (zeta - sqrt(zeta^2 - 1)) / omega if overdamped) with explicit Euler, and at every step with implicit "
      "Euler: that lies inside the measured bracket in {} of {} springs.",
      grouped_text(std::ranges::count_if(results.limits, &LimitRow::holds_theory)),
      grouped_text(static_cast<std::int64_t>(results.limits.size())));
  const auto told =
      only(told_rows(results), [](const Row& r) { return r.contact.spring.scheme == Scheme::semi_implicit; });
  if (!told.empty() && has_returned(told.back())) {
    text += fmt::format(
        " Stable is not enough for a wall that only pushes: at h omega = {:g} a semi-implicit bounce leaves with {:.2f} to {:.2f} "
        "of its speed, by phase.",
        told.back().contact.step, told.back().tally.slowest, told.back().tally.fastest);
  }
  const double ratio = results.plan.bounce_ratios.front();
  const std::vector<Row> all = passages(results, {ratio});
  const auto share = [&](std::string_view method) {
    const ContactTally& t = std::ranges::find(all, method, method_of)->tally;
    return percent_text(share_of(t.escaped, t.bounces()));
  };
  if (!all.empty()) {
    text += fmt::format(
        " At damping ratio {:g}, over all steps asked, {} of the semi-implicit bounces get through a wall that would hold in "
        "continuous time if contact is found at the poses, and {} if steps are split at the time of impact, because at first touch "
        "a spring does not push yet; with implicit Euler {} and {}.",
        ratio, share("semi_implicit discrete"), share("semi_implicit toi_split"), share("implicit_euler discrete"),
        share("implicit_euler toi_split"));
  }
  return text;
}

std::string passages_text(const StiffResults& results) {
  const auto share = [](std::string name, std::int64_t ContactTally::*count) {
    return text(std::move(name), "",
                [count](const Row& r) { return percent_text(share_of(r.tally.*count, r.tally.bounces())); });
  };
  return terminal(
      table("passages",
            fmt::format("Walls stiff enough for continuous time. Too fast: over {:g} x the speed in. Least path: "
                        "the shortest step that let a ball through, over the way from touch to the middle.",
                        results.plan.approach.blow_up),
            passages(results, results.plan.bounce_ratios), contact_columns("scheme", "detection"),
            value("bounces", "1", "", bounces_of), share("through", &ContactTally::escaped),
            share("still_there", &ContactTally::unfinished), share("too_fast", &ContactTally::blown_up),
            fields(&Row::tally, {"least_path"})));
}

std::string stiff_summary(const StiffResults& results, const std::vector<StiffClaim>& claims) {
  constexpr double one_percent = 0.01;
  const StiffPlan& plan = results.plan;
  const std::vector<double> ratios = {plan.ratios.front(), 0.1, 1, plan.ratios.back()};
  const auto springs = only(results.limits, [&](const LimitRow& r) {
    return r.spring.stiffness == plan.stiffness.front() && is_in(ratios, r.spring.damping_ratio);
  });
  Table race = times_table(cheapest(results.racers, one_percent));
  race.description = "Time a bounce, the cheapest with an error of speed out over in of at most 1 %.";
  std::string text =
      terminal(limits_table(springs), {"scheme", "stiffness", "damping_ratio", "limit", "stable", "unstable"}) + "\n" +
      terminal(bounces_table(plan, told_rows(results)),
               {"scheme", "stiffness", "damping_ratio", "step", "speed_min", "speed_max", "speed_exact"}) +
      "\n" + passages_text(results) + "\n" +
      terminal(race, {"damping_ratio", "scheme", "detection", "step", "speed_error", "bounce_ns"}) + "\n";
  const auto failed = only(claims, std::not_fn(&StiffClaim::passed));
  if (!failed.empty()) text += terminal(claims_table(failed));
  std::int64_t judged = 0;
  for (const StiffClaim& claim : claims) judged += claim.judged;
  return text + fmt::format("Self-test: {}, {} claims on {} cells.\n", verdict_text(failed.empty()), claims.size(),
                            grouped_text(judged));
}

Outcome outcome_of(const StiffResults& results) {
  const std::vector<StiffClaim> claims = stiff_claims(results);
  return {.answer = stiff_answer(results),
          .summary = stiff_summary(results, claims),
          .tables = {claims_table(claims), limits_table(results.limits),
                     table("stability", "The map: what each step does to a spring that holds both ways.",
                           flat(results.limits, &LimitRow::map), fields(std::identity())),
                     bounces_table(results.plan, results.bounces), detection_table(results),
                     table("race", "The error of a bounce against the number of its steps.", results.racers,
                           racer_columns(), fields(&Row::tally, {"returned"}),
                           value("bounces", "1", "Asked.", bounces_of), error_column(), contact_steps_column()),
                     times_table(results.racers)},
          .figures = only_measured({stability_figure(results), bounce_figure(results), escape_figure(results),
                                    detection_figure(results), race_figure(results)}),
          .self_test_passed = all_passed(claims)};
}

std::unique_ptr<Run> configure(const Settings& settings, const RunOptions& options) {
  const auto plan = std::make_shared<const StiffPlan>(make_stiff_plan(settings, options));
  StiffTasks tasks = stiff_tasks(plan);
  const auto finish = [plan](const auto& limits, const auto& contacts, const auto& racers) {
    return outcome_of({*plan, limits.results, flat(contacts.results), flat(racers.results)});
  };
  return make_run(finish, std::move(tasks.springs), std::move(tasks.walls), std::move(tasks.races));
}

}  // namespace

Experiment stiff_contact_experiment() {
  return {
      "stiff_contact",
      "A ball held by a stiff spring at a wall: which steps are stable, what does a bounce do to the energy, and when does "
      "the ball get through?",
      embedded_toml("stiff_contact"), configure};
}

}  // namespace thinwall
