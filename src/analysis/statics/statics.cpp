#include "analysis/statics/statics.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/errors.h"
#include "bearing/touchdown_touch.h"
#include "machine/build_machine.h"
#include "rotor/geometry.h"

namespace rotordrop {
namespace {

bool leans_both_ways(const std::vector<BallRowGeometry>& rows) {
  const auto leans = [&](double side) {
    return std::any_of(rows.begin(), rows.end(), [&](const auto& g) { return g.direction == side; });
  };
  return leans(1.) && leans(-1.);
}

/// The outer ring's support under a slow push from its unloaded place.
SupportRest rest_of_support(const TouchdownBearingData& d, const Eigen::Vector2d& place) {
  if (d.support_law) return d.support_law->rest(place[0], place[1]);
  const double k_y = d.support_stiffness_y, k_z = d.support_stiffness_z;
  return {-k_y * place[0],
          -k_z * place[1],
          k_y,
          0.,
          0.,
          k_z,
          0.5 * (k_y * place[0] * place[0] + k_z * place[1] * place[1])};
}

struct RingSetup {
  BentRingStatics ring;
  double axial_preload;  // force from outside that presses rows which all lean one way [N]
};

RingSetup ring_setup(const StaticsParameters& s, const TouchdownParameters& b, const TouchdownBearingData& data,
                     const Expansion& growth, double speed) {
  auto rows = data.rows;
  RingSurroundings around;
  around.radial_growth = growth.inner_race - growth.outer_race;
  around.row_difference = growth.row_difference;
  around.ball_growth = growth.ball;
  around.inner_strain = growth.inner_width / b.width;
  around.outer_strain = growth.outer_width / b.width;
  around.cage_angle = data.cage_angle;
  around.speed = speed;
  around.has_inertia = data.ball_model == BallModel::inertial;
  std::optional<PreloadSpring> spring;
  double axial = 0.;
  const bool opposed = leans_both_ways(rows);
  if (!opposed) {
    for (auto& g : rows) g.preload_offset = 0.;
    axial = b.preload * static_cast<double>(rows.size()) * rows.front().direction;
  } else if (s.preload_by == PreloadBy::spring) {
    spring = PreloadSpring{b.preload, s.preload_stiffness};  // both rows stand where it presses them
  }
  return {{RingStatics(std::move(rows), around, spring), data.bending}, axial};
}

// Radial displacement of a bent bore where it lies nearest to a rotor at e from its centre [m].
double bent_outwards(const Eigen::VectorXd& shapes, const Eigen::Vector2d& e) {
  return shapes.size() == 0 ? 0. : shape_values(shapes.size(), std::atan2(e[1], e[0])).dot(shapes);
}

}  // namespace

BearingEquilibrium bearing_equilibrium(const StaticsParameters& statics, const TouchdownParameters& b,
                                       const TouchdownBearingData& data, const BearingState& state) {
  auto [ring, axial] = ring_setup(statics, b, data, state.growth, state.speed);
  Force load = state.load;
  load.x += axial;
  const double gap = data.air_gap + state.growth.bore - state.growth.shaft;
  return BearingEquilibrium(std::move(ring), load, {data.contact, gap});
}

BearingEquilibrium bearing_equilibrium(const MachineParameters& p, const std::string& name,
                                       const TouchdownParameters& b) {
  const auto& s = p.statics;
  return bearing_equilibrium(
      s, b, touchdown_data_of(p, name, b),
      {static_growth(p, b), s.speed, {s.force[0], s.force[1], s.force[2], s.moment[0], s.moment[1], 0.}});
}

// ----------------------------------------------------------------------------------------------------------------
// the rotor on its supports

// Unknowns: y of all stations and slopes at those of free rings, z of all stations and slopes; then of every touchdown bearing the outer ring's y, z and the inner ring's six (five
// without a spring) and the coefficients of bent rings, the inner ring's relative to the outer ring.
struct ShaftEquilibrium::Touchdown {
  std::string name;
  Eigen::Index station, slope, offset;  // slope: among those of its plane; of free rings
  TouchdownBearingData data;
  BentRingStatics ring;
  double axial_preload, gap;
  [[nodiscard]] Eigen::Index n_ring() const { return ring.size(); }
  [[nodiscard]] Eigen::VectorXd shapes(const Eigen::VectorXd& q) const {
    return q.segment(ring.n_place(), ring.n_inner());
  }
};

struct ShaftEquilibrium::Linear {
  std::string name;
  Eigen::Index station;
  Eigen::Matrix2d stiffness;
};

/// Rotor against bore at one place along it.
struct ShaftEquilibrium::Pressing {
  BoreSlice slice;
  Eigen::MatrixXd by;  // [2 + n_inner, size()]: unknowns move rotor less ring along y, z, and bend the bore
  Eigen::Vector2d e;   // rotor less ring [m]
  BoreReaction bore;   // of the slice's share
};

struct ShaftEquilibrium::Sum {
  Eigen::VectorXd force;
  Eigen::MatrixXd stiffness;
  double potential = 0;
};

ShaftEquilibrium::~ShaftEquilibrium() = default;

ShaftEquilibrium::ShaftEquilibrium(const MachineParameters& p, const Node& case_node)
    : node_x_(p.rotor.geometry.node_x) {
  // Magnets have let go.
  for (const auto& entry : p.bearings)
    if (!entry.magnet()) stations_.push_back(entry.node());
  std::sort(stations_.begin(), stations_.end());
  stations_.erase(std::unique(stations_.begin(), stations_.end()), stations_.end());
  if (stations_.size() < 2)
    throw InputError(position_of(case_node, "bearings"),
                     "a rotor held at fewer than two nodes has no equilibrium: it would tip over or fall.",
                     "Give it a second support, or ask for the bearing by itself: statics.subject = \"bearings\".");
  const double length = 1e-6;
  std::vector<int> tilted;
  std::vector<double> tilts;  // by which they typically tilt [rad]
  for (const auto& entry : p.bearings)
    if (const auto* b = entry.touchdown(); b && b->ring_motion == RingMotion::free) {
      tilted.push_back(entry.node());
      tilts.push_back(length / (0.5 * b->pitch_diameter));
    }
  const std::array<double, 2> gravity = {p.run.gravity[1], p.run.gravity[2]};
  rotor_ = std::make_unique<StaticRotor>(p.rotor.geometry, stations_, gravity, p.statics.loads, tilted);

  for (int plane = 0; plane < 2; ++plane) {
    scales_.insert(scales_.end(), stations_.size(), length);
    scales_.insert(scales_.end(), tilts.begin(), tilts.end());
  }
  double preload = 0.;
  Eigen::Index n_tilted = 0;
  for (const auto& entry : p.bearings) {
    if (entry.magnet()) continue;
    const auto station =
        static_cast<Eigen::Index>(std::find(stations_.begin(), stations_.end(), entry.node()) - stations_.begin());
    if (const auto* b = entry.touchdown()) {
      const auto growth = static_growth(p, *b);
      auto data = touchdown_data_of(p, entry.name, *b);
      auto [ring, axial] = ring_setup(p.statics, *b, data, growth, p.statics.speed);
      const auto slope = static_cast<Eigen::Index>(stations_.size()) + n_tilted;
      if (data.free_ring) ++n_tilted;
      Touchdown t{entry.name,      station,         slope, static_cast<Eigen::Index>(scales_.size()),
                  std::move(data), std::move(ring), axial, air_gap(*b, p.contact) + growth.bore - growth.shaft};
      scales_.insert(scales_.end(), 2, length);
      const Eigen::VectorXd own = t.ring.scales();
      scales_.insert(scales_.end(), own.begin(), own.end());
      preload = std::max(preload, b->preload);
      is_circulatory_ = is_circulatory_ || (t.ring.ring().surroundings().has_inertia && p.statics.speed != 0.);
      touchdowns_.push_back(std::move(t));
    } else if (entry.other()) {
      throw InputError(
          {}, "the static solution does not include " + entry.name + ", a kind of support added by another program",
          "Leave it out, or let the rotor settle in a drop.");
    } else {
      const auto& K = entry.linear()->stiffness;
      linears_.push_back({entry.name, station, Eigen::Matrix2d{{K[0][0], K[0][1]}, {K[1][0], K[1][1]}}});
      is_circulatory_ = is_circulatory_ || K[0][1] != K[1][0];
    }
  }
  weight_ = rigid_body(p.rotor.geometry).mass * std::hypot(gravity[0], gravity[1]);
  double loads = 0.;
  for (const auto& load : p.statics.loads) loads += std::hypot(load.force[0], load.force[1]);
  force_scale_ = std::max({1., weight_ + loads, preload});
}

std::vector<ShaftEquilibrium::Pressing> ShaftEquilibrium::pressings(const Touchdown& t,
                                                                    const Eigen::VectorXd& x) const {
  const auto n_h = static_cast<Eigen::Index>(rotor_->n_held());
  const Eigen::Index outer = t.offset, ring = t.offset + 2, n_inner = t.ring.n_inner();
  std::vector<BoreSlice> slices = {bore_middle};
  if (t.data.free_ring) {
    const auto along = bore_slices(t.data.free_ring->contact_length);
    slices.assign(along.begin(), along.end());
  }
  std::vector<Pressing> all;
  for (const BoreSlice& slice : slices) {
    Pressing p{slice, Eigen::MatrixXd::Zero(2 + n_inner, x.size()), {}, {}};
    for (Eigen::Index i = 0; i < 2; ++i) {
      // The inner ring's place is the outer ring's and its own.
      p.by(i, i * n_h + t.station) = 1.;
      p.by(i, outer + i) = p.by(i, ring + 1 + i) = -1.;
      if (t.data.free_ring) p.by(i, i * n_h + t.slope) = slice.x;
    }
    // A point at x on the axis of a ring with the tilts psi is displaced by x (psi_z, -psi_y).
    p.by(0, ring + 4) = -slice.x;
    p.by(1, ring + 3) = slice.x;
    p.by.block(2, ring + t.ring.n_place(), n_inner, n_inner).setIdentity();
    p.e = p.by.topRows<2>() * x;
    p.bore = bore_reaction(t.data.contact, t.data.bending, t.gap, p.e, t.shapes(x.segment(ring, t.n_ring())));
    p.bore.energy *= slice.share;
    p.bore.force *= slice.share;
    p.bore.gradient *= slice.share;
    p.bore.hessian *= slice.share;
    all.push_back(std::move(p));
  }
  return all;
}

ShaftEquilibrium::Sum ShaftEquilibrium::sum(std::span<const double> unknowns, double share) const {
  const auto n = static_cast<Eigen::Index>(size()), n_h = static_cast<Eigen::Index>(rotor_->n_held());
  const Eigen::VectorXd x = Eigen::Map<const Eigen::VectorXd>(unknowns.data(), n);
  Sum s{Eigen::VectorXd::Zero(n), Eigen::MatrixXd::Zero(n, n), 0.};
  const auto& K = rotor_->stiffness();
  for (Eigen::Index plane = 0; plane < 2; ++plane) {
    const auto v = x.segment(plane * n_h, n_h);
    const auto& load = rotor_->load(static_cast<std::size_t>(plane));
    s.force.segment(plane * n_h, n_h) += load - K * v;
    s.stiffness.block(plane * n_h, plane * n_h, n_h, n_h) += K;
    s.potential += 0.5 * v.dot(K * v) - load.dot(v);
  }
  for (const auto& l : linears_) {
    const std::array<Eigen::Index, 2> at = {l.station, n_h + l.station};
    const Eigen::Vector2d v(x[at[0]], x[at[1]]);
    const Eigen::Matrix2d even = 0.5 * (l.stiffness + l.stiffness.transpose()), odd = l.stiffness - even;
    const Eigen::Matrix2d acting = even + share * odd;
    const Eigen::Vector2d f = acting * v;
    for (std::size_t i = 0; i < 2; ++i) {
      s.force[at[i]] -= f[static_cast<Eigen::Index>(i)];
      for (std::size_t j = 0; j < 2; ++j)
        s.stiffness(at[i], at[j]) += acting(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
    }
    s.potential += 0.5 * v.dot(even * v);
  }
  for (const auto& t : touchdowns_) {
    const Eigen::Index outer = t.offset, ring = t.offset + 2, m = t.n_ring();
    const Eigen::VectorXd q = x.segment(ring, m);
    const BentReaction r = t.ring.reaction(q, share);
    s.force.segment(ring, m) += r.force;
    s.stiffness.block(ring, ring, m, m) += r.stiffness;
    s.potential += r.energy;
    s.force[ring] += t.axial_preload;
    s.potential -= t.axial_preload * q[0];
    for (const Pressing& p : pressings(t, x)) {
      s.force -= p.by.transpose() * p.bore.gradient;
      s.stiffness += p.by.transpose() * p.bore.hessian * p.by;
      s.potential += p.bore.energy;
    }
    const Eigen::Vector2d ring_weight(t.data.ring_mass * t.data.gravity_y, t.data.ring_mass * t.data.gravity_z);
    const Eigen::Vector2d place = x.segment<2>(outer);
    const SupportRest carried = rest_of_support(t.data, place);
    s.force.segment<2>(outer) += ring_weight + Eigen::Vector2d(carried.force_y, carried.force_z);
    s.force.segment<2>(ring + 1) += ring_weight;
    s.stiffness.block<2, 2>(outer, outer) +=
        Eigen::Matrix2d{{carried.k_yy, carried.k_yz}, {carried.k_zy, carried.k_zz}};
    s.potential += carried.energy - ring_weight.dot(place + x.segment<2>(ring + 1));
  }
  return s;
}

void ShaftEquilibrium::forces(std::span<const double> x, std::span<double> f) const {
  const auto s = sum(x, share_);
  std::copy_n(s.force.data(), size(), f.begin());
}

void ShaftEquilibrium::stiffness(std::span<const double> x, std::span<double> K) const {
  const auto s = sum(x, share_);
  std::copy_n(s.stiffness.data(), size() * size(), K.begin());
}

double ShaftEquilibrium::potential(std::span<const double> x) const { return sum(x, 0.).potential; }

ShaftReport ShaftEquilibrium::report(std::span<const double> unknowns) const {
  const auto n_h = static_cast<Eigen::Index>(rotor_->n_held());
  const Eigen::VectorXd x = Eigen::Map<const Eigen::VectorXd>(unknowns.data(), static_cast<Eigen::Index>(size()));
  ShaftReport report;
  report.weight = weight_;
  report.node_x = node_x_;
  for (std::size_t plane = 0; plane < 2; ++plane)
    report.axis[plane] = rotor_->deflections(plane, x.segment(static_cast<Eigen::Index>(plane) * n_h, n_h));
  const auto node_of = [&](Eigen::Index station) { return stations_[static_cast<std::size_t>(station)]; };
  for (const auto& l : linears_) {
    SupportReaction r;
    r.name = l.name;
    r.node = node_of(l.station);
    const Eigen::Vector2d v(x[l.station], x[n_h + l.station]), f = -l.stiffness * v;
    r.journal = {v[0], v[1]};
    r.force_on_rotor = {f[0], f[1]};
    report.supports.push_back(std::move(r));
  }
  for (const auto& t : touchdowns_) {
    SupportReaction r;
    r.name = t.name;
    r.node = node_of(t.station);
    r.is_touchdown = true;
    r.journal = {x[t.station], x[n_h + t.station]};
    r.outer_ring = {x[t.offset], x[t.offset + 1]};
    const Eigen::VectorXd q = x.segment(t.offset + 2, t.n_ring());
    r.clearance = std::numeric_limits<double>::infinity();
    if (t.data.free_ring) r.moment_on_rotor = {0., 0.};
    for (const Pressing& p : pressings(t, x)) {
      const Eigen::Vector2d f = -p.bore.gradient.head<2>();
      r.force_on_rotor[0] += f[0];
      r.force_on_rotor[1] += f[1];
      if (r.moment_on_rotor) {
        (*r.moment_on_rotor)[0] -= p.slice.x * f[1];
        (*r.moment_on_rotor)[1] += p.slice.x * f[0];
      }
      r.clearance = std::min(r.clearance, t.gap - p.e.norm() + bent_outwards(t.shapes(q), p.e));
    }
    r.ring = report_ring(t.ring, q, 1e-6 * force_scale_);
    report.supports.push_back(std::move(r));
  }
  const auto first = static_cast<std::size_t>(stations_.front() - 1),
             last = static_cast<std::size_t>(stations_.back() - 1);
  for (std::size_t k = first; k <= last; ++k) {
    const double part = (node_x_[k] - node_x_[first]) / (node_x_[last] - node_x_[first]);
    const auto off = [&](std::size_t plane) {
      const auto& v = report.axis[plane];
      return v[k] - (1. - part) * v[first] - part * v[last];
    };
    if (const double distance = std::hypot(off(0), off(1)); distance > report.sag) {
      report.sag = distance;
      report.sag_x = node_x_[k];
    }
  }
  return report;
}

}  // namespace rotordrop
