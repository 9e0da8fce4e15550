#include <nlohmann/json.hpp>

#include <thinwall/experiments/advise/advice_text.hpp>

namespace thinwall {

namespace {

using nlohmann::ordered_json;

ordered_json optional_number(const std::optional<double>& number) {
  return number ? ordered_json(*number) : ordered_json();
}

ordered_json time_json(const QueryTime& time) {
  return {{"median", time.median}, {"lower", time.spread.lower}, {"upper", time.spread.upper}};
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
          {"in_experiment", row.method.fired}};
}

}  // namespace

ordered_json advice_json(const Advice& advice) {
  const Cell& cell = advice.wish.cell;
  ordered_json json = {
      {"speed_m_s", cell.speed},       {"radius_m", cell.radius},  {"thickness_m", cell.thickness},
      {"angle_deg", cell.angle_deg},   {"step_s", cell.step},      {"step_m", step_length(cell)},
      {"contact_m", slab_chord(cell)}, {"miss", advice.wish.miss}, {"late_m", optional_number(advice.wish.late)}};
  const AdviceRow* best = advice.advised();
  json["method"] = best == nullptr ? ordered_json() : ordered_json(best->method.name);
  json["advice"] = advice_sentence(advice);
  json["methods"] = ordered_json::array();
  for (const AdviceRow& row : advice.rows) json["methods"].push_back(row_json(row, step_length(cell)));
  return json;
}

}  // namespace thinwall
