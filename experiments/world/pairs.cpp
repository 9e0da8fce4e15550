#include <thinwall/experiments/world/pairs.hpp>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <thinwall/discrete/broad_phase.hpp>
#include <thinwall/discrete/broad_phase/r_tree.hpp>
#include <thinwall/discrete/dispatch.hpp>
#include <thinwall/swept/dispatch.hpp>

// What removing from an R-tree needs; after r_tree.hpp, which silences Boost's note about a header of its own.
#include <boost/geometry/algorithms/covered_by.hpp>
#include <boost/geometry/algorithms/equals.hpp>

namespace thinwall {

// ---- Bodies that turn.

namespace {

Obb<double> true_axes(const Obb<double>& box) {
  Mat3<double> axes;
  axes.col(0) = safe_unit(Vec3<double>(box.axes.col(0)));
  const Vec3<double> second = box.axes.col(1) - axes.col(0) * axes.col(0).dot(box.axes.col(1));
  axes.col(1) = safe_unit(second);
  const Vec3<double> third = cross<double>(axes.col(0), axes.col(1));
  axes.col(2) = third.dot(box.axes.col(2)) < 0 ? Vec3<double>(-third) : third;  // a mirrored frame stays one
  return {box.center, box.half_extents, axes};
}

struct TurnedTrue {
  const Mat3<double>& turn;

  AnyShape operator()(const Obb<double>& box) const { return true_axes(turned(box, turn)); }
  AnyShape operator()(const Capsule<double>& capsule) const {
    const Vec3<double> middle = center(capsule), half = (capsule.b - capsule.a) / 2, now = turn * half;
    const double length = safe_norm(now);
    const Vec3<double> kept = length > 0 ? Vec3<double>(now * (safe_norm(half) / length)) : now;
    return Capsule<double>{middle - kept, middle + kept, capsule.radius};
  }
  template <class A> AnyShape operator()(const A& shape) const { return shape; }
};

/// Cylinder and hemispheres share the mass as their volumes, pi r^2 length and 4/3 pi r^3.
Gyration gyration(const Capsule<double>& capsule) {
  const double r = capsule.radius, length = safe_norm(Vec3<double>(capsule.b - capsule.a)), ends = r * 4 / 3;
  const double cylinder = length + ends > 0 ? length / (length + ends) : 0, hemispheres = 1 - cylinder;
  const double along = cylinder * r * r / 2 + hemispheres * r * r * 2 / 5;
  const double across = cylinder * (length * length / 12 + r * r / 4) +
                        hemispheres * (r * r * 2 / 5 + length * length / 4 + length * r * 3 / 8);
  Gyration gyration{Mat3<double>::Identity(), {across, across, along}};
  if (length == 0) return gyration;
  const Vec3<double> axis = safe_unit(Vec3<double>(capsule.b - capsule.a));
  int least = 0;
  axis.cwiseAbs().minCoeff(&least);
  const Vec3<double> side = safe_unit(cross(axis, axis_vector<double>(least)));
  gyration.axes.col(0) = side;
  gyration.axes.col(1) = cross(axis, side);
  gyration.axes.col(2) = axis;
  return gyration;
}

Gyration gyration(const Obb<double>& box) {
  const Vec3<double> square = box.half_extents.cwiseAbs2() / 3;
  return {box.axes, {square[1] + square[2], square[0] + square[2], square[0] + square[1]}};
}
Gyration gyration(const Aabb<double>& box) { return gyration(to_obb(box)); }
Gyration gyration(const Sphere<double>& ball) {
  return {Mat3<double>::Identity(), Vec3<double>::Constant(ball.radius * ball.radius * 2 / 5)};
}
Gyration gyration(const std::monostate&) { return {}; }

}  // namespace

AnyShape turned_true(const AnyShape& shape, const Mat3<double>& turn) { return std::visit(TurnedTrue{turn}, shape); }

Gyration gyration_of(const AnyShape& shape) {
  return std::visit([](const auto& held) { return gyration(held); }, shape);
}

Mat3<double> inverse_inertia(const AnyShape& shape, double inverse_mass) {
  const Gyration of = gyration_of(shape);
  Vec3<double> inverse;
  for (int i = 0; i < 3; ++i) inverse[i] = of.squares[i] > 0 ? inverse_mass / of.squares[i] : 0;
  return of.axes * inverse.asDiagonal() * of.axes.transpose();
}

long double energy_of_turning(const Body& body) {
  using Wide = long double;
  const Gyration of = gyration_of(body.shape);
  const Vec3<Wide> rate = of.axes.cast<Wide>().transpose() * body.angular_velocity.cast<Wide>();
  return Wide(body.mass) * rate.cwiseAbs2().dot(of.squares.cast<Wide>()) / 2;
}

double farthest_point(const AnyShape& shape) {
  return of_shape(shape, 0.0, []<class A>(const A& held) {
    if constexpr (std::is_same_v<A, Aabb<double>>) {
      return safe_norm(held.half_extents);
    } else {
      return farthest(core_vectors(held)) + skin_radius(held);
    }
  });
}

Yield yield_of(const Mover& m, const Vec3<double>& arm, const Vec3<double>& normal) {
  const double inverse = inverse_mass(m.body);
  if (!m.spin || inverse == 0) return {Vec3<double>::Zero(), inverse};
  const Vec3<double> moment = cross(arm, normal);
  const Vec3<double> turn = inverse_inertia(turned_true(m.body.shape, m.spin->turned), inverse) * moment;
  return {turn, inverse + turn.dot(moment)};
}

// ---- Asking pairs.

namespace {

using SphereOrAabb = std::variant<std::monostate, Sphere<double>, Aabb<double>>;

constexpr std::size_t block_size = 1024;  // pairs; the same for any number of threads
constexpr std::size_t few = 16;           // pairs: grouping them costs more than the calls through a variant

template <class A> bool is_slow(const Moving<A>& m, double gate) {
  return safe_norm(m.displacement) <= gate * least_half_width(m.shape);
}
template <class A> bool is_slow(const Turning<A>& m, double gate) {
  return safe_norm(m.displacement) + safe_norm(m.rotation) * farthest(core_vectors(m.shape)) <=
         gate * least_half_width(m.shape);
}

/// The two stay apart whatever their spin does: straight on they do not come within what it can bridge, twice the farthest point's distance
/// from the center at most, and what their sweep takes for contact.
template <class A, class B> bool spin_is_short_of_gap(const Turning<A>& a, const Turning<B>& b) {
  const TurningPair<double> pair(a, b, 0.0);
  const double bridged = std::min(pair.a.angle, 2.0) * pair.a.off_axis + std::min(pair.b.angle, 2.0) * pair.b.off_axis;
  const double contact = 2 * (spin_sweep.tolerance * pair.speed + 4 * pair.margin);
  const Moving<A> straight_a{a.shape, a.displacement};
  const Moving<B> straight_b{b.shape, b.displacement};
  return time_of_impact(ClosedForm<double>{bridged + contact}, straight_a, straight_b).status == ToiStatus::apart;
}

/// [1] When to look again at two that touch: half of the time until when they sink no deeper into each other than by a 1024th of `least`, which is
/// the first root of the bound of their gap across a plane that stands still (docs/turning.md), let down by that much. Half, because what parts and
/// comes back, or comes down at its other end, is then apart, and its next contact is found in time.
template <class A, class B>
double look_after(const Turning<A>& a, const Turning<B>& b, const Vec3<double>& normal, double least) {
  const TurningPair<double> pair(a, b, 0.0);
  const TurningInstant<double> now = instant(pair, 0.0);
  ConcaveBound<double> bound = gap_ahead(pair, plane_riding(pair, now, Rides::world, normal), now, 0.0).bound;
  const double gap = first_root(bound, 0.0).value, sink = std::max(0x1p-10 * least, 16 * pair.margin);
  bound.gap += sink - std::min(gap, 0.0);
  const double sunk = first_root(bound, 1.0).tau;
  return sunk < 1 ? sunk / 2 : 1;
}

/// Where nothing more can be proven of two that are nearer than a millionth of what the thinner one is thick, they touch.
template <class A, class B> void take_for_contact(const Turning<A>& a, const Turning<B>& b, Toi<double>& gave_up) {
  const Separation<double> there = separation(pose_at(a, gave_up.time), pose_at(b, gave_up.time));
  if (!(there.distance <= 0x1p-20 * std::min(least_half_width(a.shape), least_half_width(b.shape)))) return;
  gave_up = {ToiStatus::hit, gave_up.evaluations, gave_up.time, there.normal, middle(there)};
}

struct Swept {
  Toi<double> toi = {};
  bool gated = false;
};

struct Sweep {
  double gate;
  bool all_spin;
  template <class A, class B> Swept operator()(const Moving<A>& a, const Moving<B>& b) const {
    if (gate > 0 && is_slow(a, gate) && is_slow(b, gate)) {
      return {time_of_impact(at_rest(a.shape), at_rest(b.shape)), true};
    }
    return {time_of_impact(a, b), false};
  }
  template <class A, class B> Swept operator()(const Turning<A>& a, const Turning<B>& b) const {
    if (gate > 0 && is_slow(a, gate) && is_slow(b, gate)) {
      return {time_of_impact(at_rest(a.shape), at_rest(b.shape)), true};
    }
    if (!all_spin && spin_is_short_of_gap(a, b)) return {};
    Toi<double> toi = time_of_impact(spin_sweep, a, b);
    if (toi.status == ToiStatus::gave_up) take_for_contact(a, b, toi);
    if (toi.status == ToiStatus::hit && toi.time == 0) toi.status = ToiStatus::overlapping;
    return {toi, false};
  }
};

struct Seen {
  std::optional<Contact<double>> contact;
  Vec3<double> point = Vec3<double>::Zero();
};

struct Look {
  template <class A, class B> Seen operator()(const Moving<A>& a, const Moving<B>& b) const {
    Seen seen{thinwall::contact(a.shape, b.shape)};
    if (seen.contact) seen.point = middle(separation(a.shape, b.shape));
    return seen;
  }
};

void keep(const ProxyPair& pair, double start, const Swept& swept, std::vector<Touch>& touches, Asked& asked) {
  const Toi<double>& toi = swept.toi;
  asked.gated += swept.gated ? 1 : 0;
  if (toi.status == ToiStatus::apart) return;
  const bool at_start = toi.status == ToiStatus::overlapping, gave_up = toi.status == ToiStatus::gave_up;
  if (toi.status == ToiStatus::invalid) throw std::logic_error("a sweep of two valid bodies has no answer");
  const double time = at_start ? start : std::min(1.0, start + toi.time * (1 - start));
  touches.push_back({pair.first, pair.second, time, at_start, gave_up, toi.normal, toi.point, 0});
}

void keep(const ProxyPair& pair, double start, const Seen& seen, std::vector<Touch>& touches, Asked&) {
  if (!seen.contact) return;
  touches.push_back(
      {pair.first, pair.second, start, true, false, seen.contact->normal, seen.point, seen.contact->penetration});
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

template <class Held> void turn_held(Held& held, const Mat3<double>& by) {
  with_shape(held, [&]<class A>(A& shape) {
    if constexpr (looks_turned<A>) shape = turned(shape, by);
  });
}

/// with_spin: of bodies that turn as well; each pair of which neither does is asked as without.
template <class Held, bool with_spin> class Kernels final : public NarrowPhase {
 public:
  Kernels(bool all_spin, int threads) : arena_(threads), threads_(threads), all_spin_(all_spin) {}

  void place(std::span<const Body> bodies, std::span<const BodyMotion> motions, std::span<const Spin> spins, double dt,
             bool resting_too) override {
    const bool is_new = list_.size() != bodies.size();
    list_.resize(bodies.size());
    if (with_spin) rotations_.resize(bodies.size(), Vec3<double>::Zero());
    for (std::uint32_t i = 0; i < bodies.size(); ++i) {
      if (is_new || resting_too || can_move(bodies[i]))
        place_one(i, bodies[i], motions[i], spin_of(spins, bodies[i], i), motions[i].anchor, dt);
    }
  }

  void place_one(std::uint32_t which, const Body& body, const BodyMotion& motion, const Spin* spin, double time,
                 double dt) override {
    Moving<Held>& placed = list_[which];
    placed.shape = as_held<Held>(body.shape);
    if constexpr (with_spin) {
      rotations_[which] = Vec3<double>::Zero();
      if (spin) {
        const Mat3<double> turn = turned_at(*spin, motion, time, dt);
        if (turn != Mat3<double>::Identity()) turn_held(placed.shape, turn);
        rotations_[which] = rotation_from(motion, *spin, time, dt);
      }
    }
    const Vec3<double> offset = offset_at(motion, time, dt);
    if (offset != Vec3<double>::Zero()) move_shape(placed.shape, offset);
    placed.displacement = moving_at(motion) * (dt * (1 - time));
  }

  Asked sweep(std::span<const ProxyPair> pairs, double start, double gate, std::vector<Touch>& touches) override {
    return ask<Swept>(pairs, start, Sweep{gate, all_spin_}, touches);
  }
  Asked look(std::span<const ProxyPair> pairs, std::vector<Touch>& touches) override {
    return ask<Seen>(pairs, 1, Look{}, touches);
  }

  bool turns(const ProxyPair& pair) const override {
    if constexpr (!with_spin) return false;
    return rotations_[pair.first] != Vec3<double>::Zero() || rotations_[pair.second] != Vec3<double>::Zero();
  }
  double until_next_look(const ProxyPair& pair, const Vec3<double>& normal) const override {
    return visit_turning(pair, 1.0, [&]<class A, class B>(const Turning<A>& a, const Turning<B>& b) {
      return look_after(a, b, normal, std::min(least_half_width(a.shape), least_half_width(b.shape)));
    });
  }

  std::size_t bytes() const override {
    std::size_t sum = list_.capacity() * sizeof(list_[0]) + blocks_.capacity() * sizeof(Block) +
                      rotations_.capacity() * sizeof(Vec3<double>);
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
    Asked asked{std::ssize(pairs), 0};
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

  /// query(a, b) as Turning; `none` where one of them has no volume, or neither is of a kind that turns.
  template <class Answer, class Query>
  Answer visit_turning(const ProxyPair& pair, const Answer& none, const Query& query) const {
    const Moving<Held>&a = list_[pair.first], &b = list_[pair.second];
    return visit_shapes(a.shape, b.shape, none, [&]<class A, class B>(const A& x, const B& y) -> Answer {
      if constexpr (with_spin && (looks_turned<A> || looks_turned<B>)) {
        return query(spinning(Moving<A>{x, a.displacement}, rotations_[pair.first]),
                     spinning(Moving<B>{y, b.displacement}, rotations_[pair.second]));
      } else {
        return none;
      }
    });
  }

  /// True where a query is asked of two that do not turn: at an instant, of any two.
  template <class Answer> bool is_straight(const ProxyPair& pair) const {
    return !std::is_same_v<Answer, Swept> || !turns(pair);
  }

  template <class Answer, class Query> Answer one(const Query& query, const ProxyPair& pair) const {
    if constexpr (with_spin && std::is_same_v<Answer, Swept>) {
      if (turns(pair)) return visit_turning(pair, Answer{}, query);
    }
    const Moving<Held>&a = list_[pair.first], &b = list_[pair.second];
    return visit_shapes(a.shape, b.shape, Answer{}, [&]<class A, class B>(const A& x, const B& y) {
      return query(Moving<A>{x, a.displacement}, Moving<B>{y, b.displacement});
    });
  }

  template <class Answer, class Query>
  void ask_block(std::span<const ProxyPair> pairs, double start, const Query& query, Block& block) {
    block.touches.clear();
    block.asked = {};
    std::vector<IndexPair> straight;
    straight.reserve(pairs.size());
    for (const ProxyPair& pair : pairs) {
      if (is_straight<Answer>(pair)) straight.push_back({pair.first, pair.second});
    }
    const auto grouped = answers(group_pairs(list_, list_, straight), list_, list_, straight, Answer{}, query);
    auto next = grouped.begin();
    for (const ProxyPair& pair : pairs) {
      keep(pair, start, is_straight<Answer>(pair) ? *next++ : one<Answer>(query, pair), block.touches, block.asked);
    }
  }

  oneapi::tbb::task_arena arena_;
  int threads_;
  bool all_spin_;
  std::vector<Moving<Held>> list_;
  std::vector<Vec3<double>> rotations_;  // [rad] in what is left of the step
  std::vector<Block> blocks_;
};

}  // namespace

std::unique_ptr<NarrowPhase> make_narrow_phase(const Plan& plan, int threads) {
  if (plan.sphere_aabb) return std::make_unique<Kernels<SphereOrAabb, false>>(false, threads);
  if (plan.spin) return std::make_unique<Kernels<AnyShape, true>>(plan.spin_within_gap, threads);
  return std::make_unique<Kernels<AnyShape, false>>(false, threads);
}

// ---- Whom a body may meet.

constexpr std::size_t searches_by_loop = 4;  // then a tree pays: it costs as much as a few dozen passes over the boxes

struct Neighbors::Tree {
  boost::geometry::index::rtree<r_tree::Entry, boost::geometry::index::quadratic<16>> boxes;
};

Neighbors::Neighbors() = default;
Neighbors::~Neighbors() = default;

void Neighbors::begin(std::vector<Proxy>& proxies, std::span<const ProxyPair> pairs, const std::vector<bool>& has_links,
                      bool everyone) {
  proxies_ = &proxies;
  pairs_ = pairs;
  has_links_ = &has_links;
  everyone_ = everyone;
  linked_ = false;
  later_.clear();
  searches_ = 0;
  tree_.reset();
}

void Neighbors::link_pairs() {
  linked_ = true;
  start_.assign(proxies_->size() + 1, 0);
  const auto each_end = [&](const auto& use) {
    for (const ProxyPair& pair : pairs_) {
      if ((*has_links_)[pair.first]) use(pair.first, pair.second);
      if ((*has_links_)[pair.second]) use(pair.second, pair.first);
    }
  };
  each_end([&](std::uint32_t from, std::uint32_t) { ++start_[from + 1]; });
  for (std::size_t i = 1; i < start_.size(); ++i) start_[i] += start_[i - 1];
  links_.resize(start_.back());
  std::vector<std::uint32_t> next(start_.begin(), start_.end() - 1);
  each_end([&](std::uint32_t from, std::uint32_t to) { links_[next[from]++] = to; });
}

/// All that the box meets, in ascending order, to found_.
void Neighbors::search(const Proxy& box) {
  found_.clear();
  const std::vector<Proxy>& proxies = *proxies_;
  if (++searches_ <= searches_by_loop) {
    for (std::uint32_t k = 0; k < proxies.size(); ++k) {
      if (boxes_touch(box, proxies[k]) && may_meet(box, proxies[k])) found_.push_back(k);
    }
    return;
  }
  if (!tree_) {
    std::vector<r_tree::Entry> entries;
    entries.reserve(proxies.size());
    for (std::uint32_t k = 0; k < proxies.size(); ++k) {
      if (!proxies[k].skipped) entries.emplace_back(r_tree::box_of(proxies[k]), k);
    }
    tree_ = std::make_unique<Tree>();
    tree_->boxes = decltype(tree_->boxes)(entries);
  }
  auto take = [&](const r_tree::Entry& entry) {
    const Proxy& other = proxies[entry.second];
    if (boxes_touch(box, other) && may_meet(box, other)) found_.push_back(entry.second);
  };
  tree_->boxes.query(boost::geometry::index::intersects(r_tree::box_of(box)), r_tree::Each(take));
  std::sort(found_.begin(), found_.end());
}

void Neighbors::change(std::uint32_t which, const Proxy& box) {
  Proxy& old = (*proxies_)[which];
  if (everyone_ || old.skipped || holds_box(old, box)) return;
  search(box);
  if (tree_) {
    tree_->boxes.remove(r_tree::Entry(r_tree::box_of(old), which));
    tree_->boxes.insert(r_tree::Entry(r_tree::box_of(box), which));
  }
  old = box;
  for (const std::uint32_t other : found_) {
    if (other == which) continue;
    later_[which].insert(other);
    if ((*has_links_)[other]) later_[other].insert(which);
  }
}

const std::vector<std::uint32_t>& Neighbors::of(std::uint32_t which) {
  answer_.clear();
  const std::vector<Proxy>& proxies = *proxies_;
  if (everyone_) {
    for (std::uint32_t k = 0; k < proxies.size(); ++k) {
      if (k != which && may_meet(proxies[which], proxies[k])) answer_.push_back(k);
    }
    return answer_;
  }
  if (!linked_) link_pairs();
  const auto first = links_.begin() + start_[which], last = links_.begin() + start_[which + 1];
  answer_.assign(first, last);
  if (const auto later = later_.find(which); later != later_.end()) {
    answer_.insert(answer_.end(), later->second.begin(), later->second.end());
  }
  std::sort(answer_.begin(), answer_.end());
  answer_.erase(std::unique(answer_.begin(), answer_.end()), answer_.end());
  return answer_;
}

std::size_t Neighbors::bytes() const {
  std::size_t sum = (start_.capacity() + links_.capacity()) * sizeof(std::uint32_t);
  for (const auto& entry : later_) sum += sizeof(entry) + entry.second.size() * 5 * sizeof(void*);  // nodes
  return tree_ ? sum + tree_->boxes.size() * sizeof(r_tree::Entry) : sum;
}

// ---- Broad phases by name.

namespace {

template <class BroadPhase> struct Named final : PairFinder {
  BroadPhase options;
  typename BroadPhase::Memory memory;
  void find(std::span<const Proxy> proxies, std::vector<ProxyPair>& pairs, std::size_t max_pairs) override {
    find_pairs(options, proxies, pairs, max_pairs, memory);
  }
};

}  // namespace

std::vector<std::string_view> pair_finder_names() { return type_names(BroadPhases{}); }

std::unique_ptr<PairFinder> make_pair_finder(std::string_view name) {
  std::unique_ptr<PairFinder> finder;
  for_each_type(BroadPhases{}, [&]<class T>(TypeTag<T>) {
    if (T::name == name) finder = std::make_unique<Named<T>>();
  });
  if (!finder) throw std::invalid_argument("there is no broad phase '" + std::string(name) + "'");
  return finder;
}

}  // namespace thinwall
