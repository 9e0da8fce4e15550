#include <thinwall/experiments/broad_phase/model.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <mutex>
#include <numeric>
#include <tuple>
#include <utility>

#include <boost/math/distributions/students_t.hpp>

#include <thinwall/discrete/broad_phase.hpp>
#include <thinwall/swept/swept_volume.hpp>
#include <thinwall/swept/time_of_impact.hpp>

namespace thinwall {

namespace {

constexpr double heap_size = 100, heap_contrast = 10;

/// `speed` long, every direction as likely: a point of the ball, drawn by rejection from its cube.
Vec3<double> random_path(double speed, const RandomStream& stream, std::uint64_t trial) {
  for (std::uint64_t draw = 2;; ++draw) {
    const RandomWords words = random_words(stream, trial, draw);
    const Vec3<double> v = {2 * uniform(words[0]) - 1, 2 * uniform(words[1]) - 1, 2 * uniform(words[2]) - 1};
    const double length = v.norm();
    if (length <= 1 && length > 0x1p-10) return v * (speed / length);
  }
}

Vec3<double> random_place(const RandomWords& words, double side) {
  return {side * uniform(words[0]), side * uniform(words[1]), side * uniform(words[2])};
}

template <class Method> class OwnFinder final : public Finder {
 public:
  void find(std::span<const Proxy> proxies) override { find_pairs(Method{}, proxies, pairs_, no_pair_limit, memory_); }
  std::vector<ProxyPair> pairs() const override { return pairs_; }
  std::optional<std::size_t> bytes() const override { return memory_.bytes() + bytes_of(pairs_); }
  bool is_exact() const override { return true; }

 private:
  typename Method::Memory memory_;
  std::vector<ProxyPair> pairs_;
};

/// Both sorted.
std::int64_t count_in_first_only(const std::vector<ProxyPair>& a, const std::vector<ProxyPair>& b) {
  std::int64_t count = 0;
  auto other = b.begin();
  for (const ProxyPair& pair : a) {
    while (other != b.end() && *other < pair) ++other;
    if (other == b.end() || *other != pair) ++count;
  }
  return count;
}

using Steps = std::array<std::vector<Proxy>, 2>;

/// [s] a call, over `calls` of them, on the boxes of one step and of the other in turn. `turn` says whose is next.
double time_calls(Finder& finder, const Steps& steps, std::int64_t calls, std::size_t& turn) {
  const double start = thread_seconds();
  for (std::int64_t i = 0; i < calls; ++i) finder.find(steps[turn ^= 1]);
  return (thread_seconds() - start) / static_cast<double>(calls);
}

constexpr std::int64_t least_rounds = 3;
constexpr double least_seconds = 1e-4;     // [s] that a round takes at least: reading the clock takes 1e-6
constexpr std::int64_t most_calls = 1000;  // a round

/// The finders have seen the first of the steps.
void time_rounds(const Steps& steps, const SurveyOptions& options, std::vector<std::unique_ptr<Finder>>& finders,
                 std::vector<Finding>& findings) {
  std::vector<std::pair<std::int64_t, std::size_t>> calls_and_turns;
  for (const auto& finder : finders) {
    std::size_t turn = 0;
    const double once = time_calls(*finder, steps, 1, turn);
    calls_and_turns.emplace_back(once > least_seconds ? 1 : most_calls, turn);
    if (once > least_seconds / static_cast<double>(most_calls) && once <= least_seconds)
      calls_and_turns.back().first = static_cast<std::int64_t>(std::ceil(least_seconds / once));
  }
  for (std::int64_t round = 0; round < options.rounds; ++round) {
    for (std::size_t k = 0; k < finders.size(); ++k) {
      auto& [calls, turn] = calls_and_turns[k];
      std::vector<double>& times = findings[k].milliseconds;
      const double spent = 1e-3 * std::accumulate(times.begin(), times.end(), 0.0) * static_cast<double>(calls);
      if (round >= least_rounds && spent > options.seconds) continue;
      times.push_back(1e3 * time_calls(*finders[k], steps, calls, turn));
    }
  }
}

constexpr std::array<std::string_view, 2> placements = {"uniform", "clustered"};

}  // namespace

std::unique_ptr<Finder> make_finder(std::string_view name) {
  if (name == bullet_build_name) return make_bullet_finder(false);
  if (name == bullet_step_name) return make_bullet_finder(true);
  std::unique_ptr<Finder> finder;
  for_each_type(BroadPhases{}, [&]<class Method>(TypeTag<Method>) {
    if (name == Method::name) finder = std::make_unique<OwnFinder<Method>>();
  });
  return finder;
}

const Factors<CrowdFactors> crowd_factors = factors<CrowdFactors>(
    choices("placement", &CrowdFactors::placement, placements, "Uniform, or clustered in heaps of about 100."),
    numbers("speed", &CrowdFactors::speed, {.lower = 0, .upper = 1000, .unit = "m"},
            "Path of a ball in a step; balls are 1 m wide."),
    counts("count", &CrowdFactors::count, 1, 10'000'000, "Balls."),
    number("density", &CrowdFactors::density, {.lower = 1e-6, .upper = 10, .unit = "1/m^3"},
           "Balls in a cubic meter."));

Crowd make_crowd(const CrowdFactors& f, std::uint64_t seed) {
  const bool clustered = f.placement == "clustered";
  const std::array<double, 4> key = {clustered ? 1.0 : 0.0, f.speed, f.density, static_cast<double>(f.count)};
  const RandomStream stream{seed, stream_of(key)}, heaps{seed, stream_of(key) + 1};
  const double side = std::cbrt(static_cast<double>(f.count) / f.density);
  const double heap_side = std::cbrt(heap_size / (heap_contrast * f.density));
  const auto heap_count = static_cast<std::uint64_t>(std::ceil(static_cast<double>(f.count) / heap_size));
  Crowd crowd;
  crowd.reserve(static_cast<std::size_t>(f.count));
  for (std::uint64_t i = 0; i < static_cast<std::uint64_t>(f.count); ++i) {
    Vec3<double> place = random_place(random_words(stream, i, 0), side);
    if (clustered) {
      const RandomWords words = random_words(stream, i, 1);
      place = random_place(random_words(heaps, words[3] % heap_count, 0), side) + random_place(words, heap_side);
    }
    crowd.push_back({Sphere<double>{place, crowd_radius}, random_path(f.speed, stream, i)});
  }
  return crowd;
}

Crowd next_step(const Crowd& crowd) {
  Crowd next = crowd;
  for (auto& ball : next) ball.shape.center += ball.displacement;
  return next;
}

std::vector<Proxy> proxies_of(const Crowd& crowd) {
  std::vector<Proxy> proxies(crowd.size());
  for (std::size_t i = 0; i < crowd.size(); ++i) {
    const Aabb<double> bounds = swept_bounds(crowd[i]);
    proxies[i].low = bounds.center - bounds.half_extents;
    proxies[i].high = bounds.center + bounds.half_extents;
  }
  return proxies;
}

std::int64_t count_meetings(const Crowd& crowd, const std::vector<ProxyPair>& pairs) {
  return std::ranges::count_if(pairs, [&](const ProxyPair& pair) {
    const ToiStatus status = time_of_impact(crowd[pair.first], crowd[pair.second]).status;
    return status == ToiStatus::hit || status == ToiStatus::overlapping;
  });
}

std::vector<std::string_view> finder_names() {
  std::vector<std::string_view> names = type_names(BroadPhases{});
  if (has_bullet()) names.insert(names.end(), {bullet_build_name, bullet_step_name});
  return names;
}

std::vector<std::string> finders_for(std::int64_t count, const SurveyOptions& options) {
  std::vector<std::string> names = options.finders;
  std::erase_if(names, [&](const std::string& name) {
    if (name == "all_pairs" || name == "all_ordered_pairs") return count > options.loops_up_to;
    return name == "sort_and_sweep" && count > options.sweep_up_to;
  });
  return names;
}

Survey survey(const CrowdFactors& factors, const SurveyOptions& options) {
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  const Crowd crowd = make_crowd(factors, options.seed);
  const Steps steps = {proxies_of(crowd), proxies_of(next_step(crowd))};
  Survey result;
  std::vector<std::unique_ptr<Finder>> finders;
  std::vector<ProxyPair> truth;
  find_pairs(UniformGrid{}, steps[0], truth);
  for (const std::string& name : finders_for(factors.count, options)) {
    finders.push_back(make_finder(name));
    Finder& finder = *finders.back();
    finder.find(steps[0]);
    if (finder.moves_on()) {  // it has moved, as in what is timed
      finder.find(steps[1]);
      finder.find(steps[0]);
    }
    const std::vector<ProxyPair> found = finder.pairs();
    if (finders.size() == 1 && finder.is_exact()) truth = found;
    Finding& f = result.findings.emplace_back();
    f.finder = name;
    f.is_exact = finder.is_exact();
    f.pairs = static_cast<std::int64_t>(found.size());
    f.missing = count_in_first_only(truth, found);
    f.extra = count_in_first_only(found, truth);
  }
  result.pairs = static_cast<std::int64_t>(truth.size());
  result.meetings = count_meetings(crowd, truth);
  time_rounds(steps, options, finders, result.findings);
  for (std::size_t k = 0; k < finders.size(); ++k) {
    if (const auto bytes = finders[k]->bytes()) result.findings[k].bytes = static_cast<std::int64_t>(*bytes);
  }
  return result;
}

// ---- What the surveys say.

std::optional<Measured> fit_growth(std::span<const GrowthPoint> points) {
  const auto n = static_cast<double>(points.size());
  if (points.size() < 3) return std::nullopt;
  double mean_x = 0, mean_y = 0;
  for (const GrowthPoint& p : points) {
    mean_x += std::log(p.count) / n;
    mean_y += std::log(p.cost) / n;
  }
  double xx = 0, xy = 0;
  for (const GrowthPoint& p : points) {
    const double x = std::log(p.count) - mean_x;
    xx += x * x;
    xy += x * (std::log(p.cost) - mean_y);
  }
  if (!(xx > 0)) return std::nullopt;
  const double slope = xy / xx;
  double residual = 0;
  for (const GrowthPoint& p : points) {
    const double off = std::log(p.cost) - mean_y - slope * (std::log(p.count) - mean_x);
    residual += off * off;
  }
  const double error = std::sqrt(residual / (n - 2) / xx);
  const double reach = error * boost::math::quantile(boost::math::students_t(n - 2), 0.975);
  return Measured{slope, {slope - reach, slope + reach}};
}

std::vector<FindingRow> findings_of(const std::vector<SurveyRow>& rows) {
  std::vector<FindingRow> all;
  for (const SurveyRow& row : rows) {
    for (const Finding& finding : row.survey.findings) all.push_back({row.crowd, finding});
  }
  return all;
}

const Finding* finding_of(const Survey& survey, std::string_view finder) {
  const auto found = std::ranges::find(survey.findings, finder, &Finding::finder);
  return found == survey.findings.end() ? nullptr : &*found;
}

std::vector<Course> courses(const std::vector<SurveyRow>& rows) {
  const std::vector<FindingRow> findings = findings_of(rows);
  std::vector<Course> all;
  for (const auto& group : group_by(findings, [](const FindingRow& row) {
         return std::tuple(row.crowd.placement, row.crowd.speed, row.finding.finder);
       })) {
    std::vector<GrowthPoint> points;
    for (const FindingRow* row : group) {
      if (row->crowd.count >= growth_from)
        points.push_back({static_cast<double>(row->crowd.count), median(row->finding.milliseconds)});
    }
    std::ranges::sort(points, {}, &GrowthPoint::count);
    all.push_back({group[0]->crowd, group[0]->finding.finder, std::ssize(points), fit_growth(points)});
  }
  return all;
}

std::int64_t loop_is_best_up_to(const std::vector<SurveyRow>& rows) {
  std::map<std::int64_t, bool> best_at;  // by count: the half loop is quickest in every world of it
  for (const SurveyRow& row : rows) {
    const Finding* loop = finding_of(row.survey, "all_pairs");
    const bool best = loop != nullptr && row.survey.findings.size() > 1 &&
                      std::ranges::all_of(row.survey.findings, [&](const Finding& f) {
                        return median(loop->milliseconds) <= median(f.milliseconds);
                      });
    best_at.try_emplace(row.crowd.count, true).first->second &= best;
  }
  std::int64_t count = 0;
  for (const auto& [n, best] : best_at) {
    if (!best) break;
    count = n;
  }
  return count;
}

bool all_right(const std::vector<SurveyRow>& rows) {
  return std::ranges::all_of(findings_of(rows), [](const FindingRow& row) { return row.finding.is_right(); });
}

}  // namespace thinwall
