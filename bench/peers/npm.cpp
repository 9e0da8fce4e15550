/// Engines that are npm packages: the shape casts that they offer, asked through node as experiments/adapters/npm/serve.mjs says, each
/// over the whole set at once. Their own JavaScript and WebAssembly is in the time, the call alone, measured beside it, is not.
/// Where the experiments are not built, this is empty.

#include "peers/peer.hpp"

#ifndef THINWALL_NPM_ENGINES

bool thinwall::bench::add_npm(const std::string&) { return false; }

#else

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

#include <thinwall/experiments/adapters/speaker.hpp>

namespace thinwall::bench {

namespace {

using nlohmann::json;

constexpr double seconds_to_start = 60, seconds_an_answer = 60;
constexpr std::size_t queries_a_question = 1000;

struct NpmCaster {
  const char* package;
  std::vector<const char*> casts;
  bool in_plane;  ///< it knows the plane alone
};

const NpmCaster& caster(const std::string& name) {
  static const std::map<std::string, NpmCaster> all = {
      {"rapier", {"@dimforge/rapier3d-compat", {"cast_shape"}, false}},
      {"jolt", {"jolt-physics", {"cast_shape", "cast_shape_back_faces"}, false}},
      {"physx", {"physx-js-webidl", {"sweep", "sweep_precise"}, false}},
      {"havok", {"@babylonjs/havok", {"shape_cast"}, false}},
      {"box2d3", {"box2d3-wasm", {"cast_shape"}, true}}};
  return all.at(name);
}

json list(const Vec3<double>& v) { return {v[0], v[1], v[2]}; }

json turned(json shape, const Vec3<double>& at, const Eigen::Quaterniond& turn = Eigen::Quaterniond::Identity()) {
  shape["at"] = list(at);
  shape["turn"] = {turn.x(), turn.y(), turn.z(), turn.w()};
  return shape;
}

json npm_shape(const Ball& s) { return turned({{"sphere", s.radius}}, s.center); }
json npm_shape(const Box& b) { return turned({{"box", list(b.half_extents)}}, b.center); }
json npm_shape(const TurnedBox& b) {
  return turned({{"box", list(b.half_extents)}}, b.center, Eigen::Quaterniond(b.axes));
}
json npm_shape(const Pill& c) {
  const Vec3<double> along = c.b - c.a;
  const auto turn = Eigen::Quaterniond::FromTwoVectors(Vec3<double>::UnitY(), along);
  return turned({{"capsule", {std::sqrt(along.squaredNorm()) / 2, c.radius}}}, center(c), turn);
}

struct NpmAnswers {
  std::vector<double> times;
  double nanoseconds = 0, call_nanoseconds = 0;  ///< [ns] a query, without the call; the call
};

template <class Query>
NpmAnswers ask_all(const std::string& engine, const std::string& cast, const QuerySet<Query>& set) {
  Speaker speaker(engine, {"node", "serve.mjs", engine}, THINWALL_NPM_ENGINES);
  (void)speaker.hear(seconds_to_start);
  NpmAnswers answers;
  for (std::size_t first = 0; first < set.queries.size(); first += queries_a_question) {
    json pairs = json::array();
    for (std::size_t k = first; k < std::min(first + queries_a_question, set.queries.size()); ++k) {
      const Query& query = set.queries[k];
      json a = npm_shape(query.a.shape);
      a["by"] = list(relative_displacement(query.a, query.b));
      pairs.push_back({std::move(a), npm_shape(query.b.shape)});
    }
    const json answer = speaker.ask({{"id", 1}, {"cast", cast}, {"pairs", std::move(pairs)}}, seconds_an_answer);
    if (answer.contains("error")) throw SpeakerError(engine + " says: " + answer.at("error").dump());
    for (const json& time : answer.at("times")) answers.times.push_back(time.is_null() ? never : time.get<double>());
    answers.nanoseconds += (answer.at("seconds").get<double>() - answer.at("call_seconds").get<double>()) * 1e9;
    answers.call_nanoseconds += answer.at("call_seconds").get<double>() * 1e9;
  }
  if (answers.times.size() != set.queries.size()) throw SpeakerError(engine + " answers another number of queries");
  answers.nanoseconds = std::max(0.0, answers.nanoseconds) / static_cast<double>(answers.times.size());
  answers.call_nanoseconds /= static_cast<double>(answers.times.size());
  return answers;
}

template <class Query>
void add_npm_row(const std::string& name, const std::string& engine, const std::string& cast,
                 const QuerySet<Query>& (*set)(), const Operations& least) {
  benchmark::RegisterBenchmark(name.c_str(),
                               [=](benchmark::State& state) {
                                 try {
                                   NpmAnswers answers;
                                   for (auto _ : state) {
                                     answers = ask_all(engine, cast, set());
                                     state.SetIterationTime(answers.nanoseconds * 1e-9);
                                   }
                                   std::size_t next = 0;
                                   add_errors(state,
                                              errors_of(set(), [&](const Query&) { return answers.times[next++]; }));
                                   state.counters["ns_row"] = answers.nanoseconds;
                                   state.counters["call_ns"] = answers.call_nanoseconds;
                                   add_query_floor(state, set().queries, least);
                                 } catch (const std::exception& error) {
                                   state.SkipWithError(error.what());
                                 }
                               })
      ->Iterations(1)
      ->UseManualTime();
}

}  // namespace

bool add_npm(const std::string& engine) {
  const NpmCaster& one = caster(engine);
  static const bool has_node = std::system("command -v node >/dev/null") == 0;
  if (!has_node || !std::filesystem::exists(std::filesystem::path(THINWALL_NPM_ENGINES) / "node_modules" / one.package))
    return false;
  for_each_cast([&](const std::string& pair, auto set, const Operations& least) {
    if (one.in_plane && pair != in_plane) return;
    for (const char* cast : one.casts)
      add_npm_row("time_of_impact/" + pair + "/" + engine + "_" + cast, engine, cast, set, least);
  });
  return true;
}

}  // namespace thinwall::bench

#endif
