#include <thinwall/experiments/speed/timed_way.hpp>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include <thinwall/experiments/random.hpp>
#include <thinwall/experiments/speed/bench_program.hpp>

namespace thinwall {

namespace {

constexpr std::string_view peers_program = "peers";
constexpr std::array<std::pair<std::string_view, std::string_view>, 5> peer_names = {
    {{"bullet", "Bullet"}, {"ode", "ODE"}, {"fcl", "FCL"}, {"libccd", "libccd"}, {"thinwall", "thinwall"}}};

std::string spaced(std::string text) {
  std::replace(text.begin(), text.end(), '_', ' ');
  std::replace(text.begin(), text.end(), '/', ' ');
  for (const auto& [low, high] : {std::pair{"gjk", "GJK"}, {"mpr", "MPR"}}) {
    if (const std::size_t at = text.find(low); at != std::string::npos) text.replace(at, 3, high);
  }
  return text;
}

bool is_front_door(const TimedWay& c) {
  return c.way == "front_door" || (c.program == peers_program && c.way == "thinwall");
}

void add_round(TimedWay& timed, const BenchRow& row) {
  std::map<std::string, double> errors = row.counters;
  const auto take = [&](const char* counter, std::vector<double>& into) {
    const auto found = errors.find(counter);
    if (found == errors.end()) return;
    into.push_back(found->second);
    errors.erase(found);
  };
  take("floor_ns", timed.floor_ns);
  take("to_floor", timed.to_floor);
  if (timed.nanoseconds.empty()) timed.errors = errors;
  timed.errors_agree = timed.errors_agree && timed.errors == errors;
  timed.nanoseconds.push_back(row.nanoseconds);
}

}  // namespace

std::vector<TimedWay> ways(const std::vector<BenchOutput>& rounds) {
  std::vector<TimedWay> all;
  for (const std::string_view program : bench_program_names()) {
    for (const BenchOutput& output : rounds) {
      if (output.program != program) continue;
      for (const BenchRow& row : output.rows) {
        const auto same = [&](const TimedWay& c) {
          return c.program == program && c.kind == row.kind && c.subject == row.subject && c.way == row.way;
        };
        auto found = std::find_if(all.begin(), all.end(), same);
        if (found == all.end())
          found = all.insert(all.end(), {std::string(program), row.kind, row.subject, row.way, {}, {}, {}, {}, true});
        add_round(*found, row);
      }
    }
  }
  return all;
}

WayTime time_of(const TimedWay& timed) {
  const std::array<double, 1> key = {static_cast<double>(timed.nanoseconds.size())};
  return {median(timed.nanoseconds), bootstrap_median(timed.nanoseconds, {1, stream_of(key)})};
}

std::optional<double> error_of(const TimedWay& timed, const std::string& counter) {
  const auto found = timed.errors.find(counter);
  return found == timed.errors.end() ? std::nullopt : std::optional(found->second);
}

bool is_peer(const TimedWay& c) { return c.program == peers_program && !is_front_door(c); }

std::string name_of(const TimedWay& c) {
  if (is_front_door(c)) return "thinwall, front door";
  if (c.way == "plain") return "plain form";
  if (c.program != peers_program) return "thinwall, " + spaced(c.way);
  for (const auto& [prefix, name] : peer_names) {
    if (!c.way.starts_with(prefix)) continue;
    const std::string rest = c.way.substr(prefix.size());
    return rest.empty() ? std::string(name) : std::string(name) + "," + spaced(rest);
  }
  return c.way;
}

std::vector<const TimedWay*> drawn_ways(const std::vector<TimedWay>& all) {
  std::vector<const TimedWay*> drawn;
  for (const TimedWay& c : all) {
    if (c.kind != "time_of_impact" || !error_of(c, "p99_length") || c.program == "methods") continue;
    const auto same = [&](const TimedWay* other) {
      return other->subject == c.subject && name_of(*other) == name_of(c);
    };
    if (std::any_of(drawn.begin(), drawn.end(), same)) continue;
    const auto beyond = [&](const TimedWay* other) { return other->subject == c.subject; };
    const auto last = std::find_if(drawn.rbegin(), drawn.rend(), beyond);  // pairs stay together
    drawn.insert(last == drawn.rend() ? drawn.end() : last.base(), &c);
  }
  return drawn;
}

const TimedWay* front_door_for(const std::vector<TimedWay>& all, const TimedWay& timed) {
  const TimedWay* found = nullptr;
  for (const TimedWay& c : all) {
    if (c.kind != timed.kind || c.subject != timed.subject || !is_front_door(c)) continue;
    if (c.program == timed.program) return &c;  // the same run
    if (found == nullptr) found = &c;
  }
  return found;
}

}  // namespace thinwall
