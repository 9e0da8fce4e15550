// Begin once, stay, end on the n-th consecutive step apart.

#include <thinwall/discrete/collision_events.hpp>

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

namespace thinwall::testing {
namespace {

using Kind = CollisionEventKind;

std::string letters(const CollisionEvents& events) {
  std::string text;
  for (const CollisionEvent& event : events.events()) text += "bse"[static_cast<int>(event.kind)];
  return text;
}

/// What every step tells, each followed by a dot.
std::string told(int grace, const std::vector<bool>& meets) {
  CollisionEvents events(grace);
  std::string all;
  for (const bool meets_now : meets) {
    if (meets_now) events.meet(1, 2, static_cast<double>(events.steps()));
    events.finish_step(static_cast<double>(events.steps()) + 1);
    all += letters(events) + ".";
  }
  EXPECT_EQ(events.live(), meets.back() ? 1U : 0U);
  return all;
}

TEST(CollisionEvents, begin_once_stay_and_end_on_the_nth_consecutive_step_apart) {
  EXPECT_EQ(told(1, {false, true, true, false, false, true}), ".b.s.e..b.");
  EXPECT_EQ(told(3, {true, false, false, true, false, false, false, false}), "b...s...e..");
  EXPECT_EQ(told(0, {true, false}), "b.e.");  // less than one is one
}

TEST(CollisionEvents, tell_the_ids_in_order_the_earliest_time_and_the_step) {
  CollisionEvents events;
  events.meet(7, 3, 0.5);
  events.meet(3, 7, 0.25);
  events.meet(9, 1, 0.75);
  events.meet(4, 4, 0.75);  // a body does not meet itself
  events.finish_step(1);
  ASSERT_EQ(events.events().size(), 2U);
  EXPECT_EQ(events.events()[0], (CollisionEvent{Kind::begin, 1, 9, 1, 0.75, false}));
  EXPECT_EQ(events.events()[1], (CollisionEvent{Kind::begin, 3, 7, 1, 0.25, false}));
}

TEST(CollisionEvents, end_at_once_when_a_body_is_removed) {
  CollisionEvents events(5);
  std::string heard;
  events.listen([&](const CollisionEvent& event) { heard += event.removed ? "r" : "."; });
  events.meet(1, 2, 0);
  events.meet(2, 3, 0);
  events.meet(4, 5, 0);
  events.finish_step(1);
  events.meet(2, 9, 1.5);  // in the step that is under way
  events.remove(2, 1.5);
  EXPECT_EQ(heard, "...rr");
  EXPECT_EQ(events.live(), 1U);
  events.finish_step(2);
  ASSERT_EQ(letters(events), "ee");  // the readers of the list see them too, once
  EXPECT_EQ(events.events()[0], (CollisionEvent{Kind::end, 1, 2, 1, 1.5, true}));
  EXPECT_EQ(events.events()[1], (CollisionEvent{Kind::end, 2, 3, 1, 1.5, true}));
  EXPECT_EQ(heard, "...rr");  // and the listeners do not hear them twice
  events.finish_step(3);
  EXPECT_EQ(letters(events), "");
  events.remove(77, 3);  // who never met anybody
  EXPECT_EQ(heard, "...rr");
}

TEST(CollisionEvents, let_a_listener_remove_a_body_and_tell_no_end_before_its_begin) {
  CollisionEvents events;
  std::vector<CollisionEvent> heard;
  events.listen([&](const CollisionEvent& event) {
    heard.push_back(event);
    if (event.kind == Kind::begin && event.second == 2) events.remove(2, 1);
  });
  events.meet(1, 2, 0);
  events.meet(2, 3, 0);
  events.meet(3, 4, 0);
  events.finish_step(1);
  EXPECT_EQ(letters(events), "bbbee");
  EXPECT_EQ(heard, events.events());
  EXPECT_EQ(events.live(), 1U);
}

TEST(CollisionEvents, let_listeners_come_and_go_while_they_are_told) {
  CollisionEvents events;
  int first = 0, second = 0;
  std::size_t number = 0;
  number = events.listen([&](const CollisionEvent&) {
    ++first;
    events.forget(number);
    events.listen([&](const CollisionEvent&) { ++second; });
  });
  events.meet(1, 2, 0);
  events.meet(3, 4, 0);
  events.finish_step(1);
  EXPECT_EQ(first, 1);
  EXPECT_GE(second, 1);
}

TEST(CollisionEvents, are_told_to_all_that_stay_when_a_listener_goes) {
  CollisionEvents events;
  std::string heard;
  std::size_t number = 0, later = 0;
  number = events.listen([&](const CollisionEvent&) {
    heard += "1";
    events.forget(number);
  });
  events.listen([&](const CollisionEvent&) { heard += "2"; });
  events.listen([&](const CollisionEvent&) {
    heard += "3";
    events.forget(later);
  });
  later = events.listen([&](const CollisionEvent&) { heard += "4"; });
  events.listen([&](const CollisionEvent&) { heard += "5"; });
  events.meet(1, 2, 0);
  events.meet(3, 4, 0);
  events.finish_step(1);
  EXPECT_EQ(heard, "1235235");
}

TEST(CollisionEvents, of_a_removal_by_a_listener_of_a_removal_are_told_after_it) {
  CollisionEvents events;
  for (const std::uint32_t other : {2U, 3U}) events.meet(1, other, 0);
  events.meet(2, 4, 0);
  events.finish_step(1);
  std::vector<CollisionEvent> heard;
  events.listen([&](const CollisionEvent& event) {
    heard.push_back(event);
    if (event.removed && event.second == 2) events.remove(2, 1.5);
  });
  events.remove(1, 1.5);
  ASSERT_EQ(heard.size(), 3U);
  events.finish_step(2);
  EXPECT_EQ(heard, events.events());
}

TEST(CollisionEvents, log_the_names) {
  CollisionEvents events;
  events.name(1, "bullet");
  events.name(2, "wall");
  events.meet(2, 1, 1.25);
  events.finish_step(2);
  EXPECT_EQ(events.to_text(events.events()[0]), "1.25 s: bullet meets wall");
  events.meet(2, 1, 2.25);
  events.meet(3, 1, 2.5);
  events.finish_step(3);
  EXPECT_EQ(events.to_text(events.events()[0]), "2.25 s: bullet stays on wall");
  EXPECT_EQ(events.to_text(events.events()[1]), "2.5 s: bullet meets body 3");
  events.finish_step(4);
  EXPECT_EQ(events.to_text(events.events()[0]), "4 s: bullet leaves wall");
  events.remove(3, 5);
  events.meet(1, 2, 5);
  events.finish_step(6);
  events.remove(1, 6.5);
  events.finish_step(7);
  EXPECT_EQ(events.to_text(events.events()[0]), "6.5 s: bullet leaves wall (removed)");
}

TEST(CollisionEvents, alternate_begin_and_end_for_every_pair_whatever_happens) {
  std::uint64_t state = 1;
  const auto draw = [&](std::uint64_t below) {  // a small generator of our own: the test needs no good one
    state = state * 6364136223846793005 + 1442695040888963407;
    return (state >> 33) % below;
  };
  for (int run = 0; run < 300; ++run) {
    CollisionEvents events(static_cast<int>(1 + draw(3)));
    std::map<std::pair<std::uint32_t, std::uint32_t>, bool> open;
    events.listen([&](const CollisionEvent& event) {
      bool& is_open = open[{event.first, event.second}];
      EXPECT_EQ(is_open, event.kind != Kind::begin);
      is_open = event.kind != Kind::end;
      if (draw(20) == 0) events.remove(event.first, 0);
    });
    for (int steps = 0; steps < 30; ++steps) {
      for (std::uint64_t met = draw(6); met > 0; --met) {
        const auto a = static_cast<std::uint32_t>(draw(6));
        events.meet(a, static_cast<std::uint32_t>(draw(6)), 0);
      }
      if (draw(10) == 0) events.remove(static_cast<std::uint32_t>(draw(6)), 0);
      events.finish_step(0);
    }
    for (std::uint32_t id = 0; id < 6; ++id) events.remove(id, 0);
    events.finish_step(0);
    EXPECT_EQ(events.live(), 0U);
    for (const auto& [pair, is_open] : open) EXPECT_FALSE(is_open);
  }
}

}  // namespace
}  // namespace thinwall::testing
