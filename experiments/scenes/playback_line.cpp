/// A playback as one line of JSON: what the journal keeps.
#include <stdexcept>

#include <nlohmann/json.hpp>

#include <thinwall/experiments/scenes/playback.hpp>

namespace thinwall {

namespace {

using nlohmann::json;

json list_of(const StepRow& r) {
  return {r.step,     r.time,    r.pairs,  r.sweeps, r.gated,    r.hits,
          r.impulses, r.waiting, r.begins, r.ends,   r.tunneled, r.energy};
}

StepRow row_from(const json& j) {
  return {j.at(0), j.at(1), j.at(2), j.at(3), j.at(4), j.at(5), j.at(6), j.at(7), j.at(8), j.at(9), j.at(10), j.at(11)};
}

CollisionEvent event_from(const json& j) {
  CollisionEvent event;
  event.kind = j.at(0).get<int>() == 0 ? CollisionEventKind::begin : CollisionEventKind::end;
  event.first = j.at(1);
  event.second = j.at(2);
  event.step = j.at(3);
  event.time = j.at(4);
  event.removed = j.at(5);
  return event;
}

}  // namespace

std::string to_line(const Playback& p) {
  json out = {{"all_events", p.all_events},
              {"all_missed", p.all_missed},
              {"live", p.live},
              {"energy", p.energy},
              {"hash", p.hash},
              {"bytes", p.bytes}};
  for (const char* key : {"rows", "events", "missed", "tracks", "places", "phases"}) out[key] = json::array();
  for (const StepRow& row : p.rows) out["rows"].push_back(list_of(row));
  for (const CollisionEvent& e : p.events) {
    const int kind = e.kind == CollisionEventKind::begin ? 0 : 1;
    out["events"].push_back({kind, e.first, e.second, e.step, e.time, e.removed});
  }
  for (const MissedContact& m : p.missed) out["missed"].push_back({m.first, m.second, m.time});
  for (const Track& t : p.tracks) out["tracks"].push_back({{"id", t.id}, {"x", t.x}, {"y", t.y}});
  for (const auto& [id, at] : p.places) out["places"].push_back({id, at[0], at[1], at[2]});
  for (const PhaseTime& phase : p.phases) out["phases"].push_back({phase.total, phase.most});
  return out.dump();
}

Playback playback_from_line(const std::string& line) {
  try {
    const json in = json::parse(line);
    Playback p;
    p.all_events = in.at("all_events");
    p.all_missed = in.at("all_missed");
    p.live = in.at("live");
    p.energy = in.at("energy");
    p.hash = in.at("hash");
    p.bytes = in.at("bytes");
    for (const json& row : in.at("rows")) p.rows.push_back(row_from(row));
    for (const json& event : in.at("events")) p.events.push_back(event_from(event));
    for (const json& m : in.at("missed")) p.missed.push_back({m.at(0), m.at(1), m.at(2)});
    for (const json& t : in.at("tracks")) p.tracks.push_back({t.at("id"), t.at("x"), t.at("y")});
    for (const json& at : in.at("places")) p.places.emplace_back(at.at(0), Vec3<double>(at.at(1), at.at(2), at.at(3)));
    for (std::size_t i = 0; i < p.phases.size(); ++i)
      p.phases[i] = {in.at("phases").at(i).at(0), in.at("phases").at(i).at(1)};
    return p;
  } catch (const json::exception& error) {
    throw std::runtime_error(std::string("not a playback: ") + error.what());
  }
}

}  // namespace thinwall
