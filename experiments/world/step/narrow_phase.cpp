#include <thinwall/experiments/world/step/narrow_phase.hpp>

#include <algorithm>
#include <optional>
#include <stdexcept>

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <thinwall/discrete/grouped_pairs.hpp>
#include <thinwall/swept/dispatch.hpp>

namespace thinwall {
namespace {

using SphereOrAabb = std::variant<std::monostate, Sphere<double>, Aabb<double>>;

constexpr std::size_t block_size = 1024;  // pairs; the same for any number of threads
constexpr std::size_t few = 16;           // pairs: grouping them costs more than the calls through a variant

double least_half_width(const Sphere<double>& s) { return s.radius; }
double least_half_width(const Aabb<double>& b) { return b.half_extents.minCoeff(); }
double least_half_width(const Obb<double>& b) { return b.half_extents.minCoeff(); }
double least_half_width(const Capsule<double>& c) { return c.radius; }

template <class A> bool is_slow(const Moving<A>& m, double gate) {
  return safe_norm(m.displacement) <= gate * least_half_width(m.shape);
}

struct Swept {
  Toi<double> toi;
  bool gated = false;
};

struct Sweep {
  double gate;
  template <class A, class B> Swept operator()(const Moving<A>& a, const Moving<B>& b) const {
    if (gate > 0 && is_slow(a, gate) && is_slow(b, gate)) {
      return {time_of_impact(at_rest(a.shape), at_rest(b.shape)), true};
    }
    return {time_of_impact(a, b), false};
  }
};

struct Seen {
  std::optional<Contact<double>> contact;
  Vec3<double> point = Vec3<double>::Zero();
};

struct Look {
  template <class A, class B> Seen operator()(const Moving<A>& a, const Moving<B>& b) const {
    Seen seen{thinwall::contact(a.shape, b.shape)};
    if (seen.contact) seen.point = center(a.shape) + seen.contact->local_a;
    return seen;
  }
};

void keep(const ProxyPair& pair, double start, const Swept& swept, std::vector<Touch>& touches, Asked& asked) {
  const Toi<double>& toi = swept.toi;
  asked.gated += swept.gated ? 1 : 0;
  if (toi.status == ToiStatus::apart) return;
  const bool at_start = toi.status == ToiStatus::overlapping;
  if (!at_start && toi.status != ToiStatus::hit) throw std::logic_error("a sweep of two valid bodies has no answer");
  const double time = at_start ? start : std::min(1.0, start + toi.time * (1 - start));
  touches.push_back({pair.first, pair.second, time, at_start, toi.normal, toi.point, 0});
}

void keep(const ProxyPair& pair, double start, const Seen& seen, std::vector<Touch>& touches, Asked&) {
  if (!seen.contact) return;
  touches.push_back(
      {pair.first, pair.second, start, true, seen.contact->normal, seen.point, seen.contact->penetration});
}

template <class Held> Held as_held(const AnyShape& shape) {
  return std::visit(
      [](const auto& s) -> Held {
        if constexpr (std::is_constructible_v<Held, decltype(s)>) {
          return s;
        } else {
          throw std::logic_error("a shape for which no kernel was planned");
        }
      },
      shape);
}

template <class Held> void move_held(Held& shape, const Vec3<double>& by) {
  std::visit(
      [&](auto& s) {
        if constexpr (!std::is_same_v<decltype(s), std::monostate&>) s = moved(s, by);
      },
      shape);
}

template <class Held> class Kernels final : public NarrowPhase {
 public:
  explicit Kernels(int threads) : arena_(threads), threads_(threads) {}

  void place(std::span<const Body> bodies, std::span<const BodyMotion> motions, double dt, bool resting_too) override {
    const bool is_new = list_.size() != bodies.size();
    list_.resize(bodies.size());
    for (std::uint32_t i = 0; i < bodies.size(); ++i) {
      if (is_new || resting_too || can_move(bodies[i])) place_one(i, bodies[i], motions[i], motions[i].anchor, dt);
    }
  }

  void place_one(std::uint32_t which, const Body& body, const BodyMotion& motion, double time, double dt) override {
    Moving<Held>& placed = list_[which];
    placed.shape = as_held<Held>(body.shape);
    const Vec3<double> offset = offset_at(motion, time, dt);
    if (offset != Vec3<double>::Zero()) move_held(placed.shape, offset);
    placed.displacement = moving_at(motion) * (dt * (1 - time));
  }

  Asked sweep(std::span<const ProxyPair> pairs, double start, double gate, std::vector<Touch>& touches) override {
    return ask<Swept>(pairs, start, Sweep{gate}, touches);
  }
  Asked look(std::span<const ProxyPair> pairs, std::vector<Touch>& touches) override {
    return ask<Seen>(pairs, 1, Look{}, touches);
  }

  std::size_t bytes() const override {
    std::size_t sum = list_.capacity() * sizeof(list_[0]) + blocks_.capacity() * sizeof(Block);
    for (const Block& block : blocks_) sum += block.touches.capacity() * sizeof(Touch);
    return sum;
  }

 private:
  struct Block {
    std::vector<Touch> touches;
    Asked asked;
  };

  template <class Answer, class Query>
  Asked ask(std::span<const ProxyPair> pairs, double start, const Query& query, std::vector<Touch>& touches) {
    Asked asked{pairs.size(), 0};
    if (pairs.size() <= few) {
      for (const ProxyPair& pair : pairs) keep(pair, start, one<Answer>(query, pair), touches, asked);
      return asked;
    }
    const std::size_t count = (pairs.size() + block_size - 1) / block_size;
    if (blocks_.size() < count) blocks_.resize(count);
    const auto run = [&](std::size_t k) {
      const std::size_t first = k * block_size;
      ask_block<Answer>(pairs.subspan(first, std::min(block_size, pairs.size() - first)), start, query, blocks_[k]);
    };
    if (threads_ == 1) {
      for (std::size_t k = 0; k < count; ++k) run(k);
    } else {
      const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism,
                                              static_cast<std::size_t>(threads_));
      arena_.execute([&] { oneapi::tbb::parallel_for(std::size_t{0}, count, run); });
    }
    for (std::size_t k = 0; k < count; ++k) {
      touches.insert(touches.end(), blocks_[k].touches.begin(), blocks_[k].touches.end());
      asked.gated += blocks_[k].asked.gated;
    }
    return asked;
  }

  template <class Answer, class Query> Answer one(const Query& query, const ProxyPair& pair) const {
    const Moving<Held>&a = list_[pair.first], &b = list_[pair.second];
    return visit_shapes(a.shape, b.shape, Answer{}, [&]<class A, class B>(const A& x, const B& y) {
      return query(Moving<A>{x, a.displacement}, Moving<B>{y, b.displacement});
    });
  }

  template <class Answer, class Query>
  void ask_block(std::span<const ProxyPair> pairs, double start, const Query& query, Block& block) {
    block.touches.clear();
    block.asked = {};
    std::vector<IndexPair> places;
    places.reserve(pairs.size());
    for (const ProxyPair& pair : pairs) places.push_back({pair.first, pair.second});
    const auto all = answers(group_pairs(list_, list_, places), list_, list_, places, Answer{}, query);
    for (std::size_t i = 0; i < pairs.size(); ++i) keep(pairs[i], start, all[i], block.touches, block.asked);
  }

  oneapi::tbb::task_arena arena_;
  int threads_;
  std::vector<Moving<Held>> list_;
  std::vector<Block> blocks_;
};

}  // namespace

std::unique_ptr<NarrowPhase> make_narrow_phase(bool sphere_aabb, int threads) {
  if (sphere_aabb) return std::make_unique<Kernels<SphereOrAabb>>(threads);
  return std::make_unique<Kernels<AnyShape>>(threads);
}

}  // namespace thinwall
