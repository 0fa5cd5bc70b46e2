// Bases that were asked for last are kept: whatever else was asked for in between, a rotor gets its own.
// Of a uniform shaft of k times Young's modulus all frequencies are sqrt(k) times as high; modes of lower ones stay when the cut-off falls.
#include <gtest/gtest.h>

#include <thread>
#include <vector>

#include "rotor/modal_basis.h"
#include "test_rotors.h"

namespace rotordrop {
namespace {

using rotordrop::testing::uniform_beam;

RotorGeometry stiffer(double factor) {
  auto geometry = uniform_beam(20, 0.1);
  for (auto& element : geometry.elements) element.material.E *= factor;
  return geometry;
}

TEST(KeptBases, BelongToTheRotorThatAsks) {
  const double cut_off = 1e4;
  const auto first = free_free_modes(stiffer(1.), cut_off);
  ASSERT_GT(first.n_modes(), 4);
  // More rotors than are kept, twice over.
  for (int round = 0; round < 2; ++round)
    for (const double factor : {1., 4., 9., 16., 25., 36.}) {
      const auto basis = free_free_modes(stiffer(factor), std::sqrt(factor) * cut_off);
      ASSERT_EQ(basis.n_modes(), first.n_modes()) << factor;
      for (Eigen::Index k = 2; k < first.n_modes(); ++k)
        EXPECT_NEAR(basis.omega(k) / first.omega(k), std::sqrt(factor), 1e-6) << "of a stiffness matrix spanning 1e8";
    }
  const auto fewer = free_free_modes(stiffer(1.), 0.5 * cut_off);
  EXPECT_LT(fewer.n_modes(), first.n_modes());
  EXPECT_GT(free_free_modes(stiffer(1.), cut_off, {2}).n_modes(), first.n_modes())
      << "one shape for the node's flexibility";
  auto heavier = stiffer(1.);
  heavier.mass_points.push_back({5, 10., 0., 0.});
  EXPECT_NEAR(free_free_modes(heavier, cut_off).body.mass - first.body.mass, 10., 1e-12);
  auto longer = stiffer(1.);
  for (double& x : longer.node_x) x *= 2.;
  EXPECT_NEAR(free_free_modes(longer, cut_off).body.mass / first.body.mass, 2., 1e-12);

  const auto again = free_free_modes(stiffer(1.), cut_off);
  EXPECT_EQ(again.omega, first.omega);
  EXPECT_EQ(again.shape, first.shape);
  EXPECT_EQ(again.gyroscopic, first.gyroscopic);
}

TEST(KeptBases, AreSharedByThreads) {
  const auto alone = free_free_modes(stiffer(2.), 1e4);
  std::vector<Eigen::VectorXd> found(4);
  {
    std::vector<std::jthread> threads;
    for (std::size_t i = 0; i < found.size(); ++i)
      threads.emplace_back([&found, i] {
        for (int round = 0; round < 20; ++round) {
          EXPECT_GT(free_free_modes(stiffer(3. + static_cast<double>(i)), 1e4).n_modes(), 2);
          found[i] = free_free_modes(stiffer(2.), 1e4).omega;
        }
      });
  }
  for (const auto& omega : found) EXPECT_EQ(omega, alone.omega);
}

}  // namespace
}  // namespace rotordrop
