// Points of a study that rank 0 shares with another rank, which here is this test.
#include <gtest/gtest.h>

#include <chrono>
#include <deque>
#include <set>
#include <thread>

#include "study/many/ranks/shared_points.h"

namespace rotordrop {
namespace {

using namespace std::chrono_literals;

/// Two ranks; what rank 1 says is put into `mail`, what it is told is in `told`.
class TwoRanks final : public Ranks {
 public:
  [[nodiscard]] int rank() const override { return 0; }
  [[nodiscard]] int size() const override { return 2; }
  bool begin(bool does_begin) override { return does_begin; }
  [[nodiscard]] bool has_begun() const override { return true; }
  void send(int, Kind, long point) override { told.push_back(point); }
  std::optional<Message> receive() override {
    if (mail.empty()) return {};
    const Message first = mail.front();
    mail.pop_front();
    return first;
  }
  void leave(bool) override {}
  std::deque<Message> mail;
  std::vector<long> told;
};

std::set<std::size_t> all_of(PointSource& points) {
  std::set<std::size_t> taken;
  while (const auto point = points.next()) taken.insert(*point);
  return taken;
}

TEST(SharedPoints, OfASilentRankAreComputedByRankZero) {
  TwoRanks ranks;
  std::vector<std::string> told;
  SharedPoints points(
      {4, 5, 6, 7}, ranks, false, [&](const std::string& text) { told.push_back(text); }, 30ms);
  ranks.mail = {{1, Ranks::Kind::want, -1}, {1, Ranks::Kind::want, -1}};
  points.serve(false);
  EXPECT_EQ(ranks.told, (std::vector<long>{4, 5}));
  ranks.mail = {{1, Ranks::Kind::done, 4}};
  points.serve(false);
  EXPECT_FALSE(points.is_complete());
  EXPECT_FALSE(points.is_anyone_lost());
  std::this_thread::sleep_for(60ms);
  points.serve(false);
  EXPECT_TRUE(points.is_anyone_lost());
  ASSERT_EQ(told.size(), 1U);
  EXPECT_NE(told[0].find("rank 1 is silent"), std::string::npos);
  EXPECT_EQ(all_of(points), (std::set<std::size_t>{5, 6, 7})) << "all but the one that rank 1 had finished";
  EXPECT_TRUE(points.is_complete());
}

TEST(SharedPoints, ARankThatSaysThatItLivesIsNotGivenUp) {
  TwoRanks ranks;
  SharedPoints points({1, 2}, ranks, false, {}, 40ms);
  ranks.mail = {{1, Ranks::Kind::want, -1}};
  points.serve(false);
  for (int i = 0; i < 8; ++i) {
    std::this_thread::sleep_for(10ms);
    ranks.mail = {{1, Ranks::Kind::alive, -1}};
    points.serve(false);
  }
  EXPECT_FALSE(points.is_anyone_lost());
}

}  // namespace
}  // namespace rotordrop
