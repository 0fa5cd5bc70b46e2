#include "bearing/support/magnet_support.h"

#include <cmath>
#include <utility>

namespace rotordrop {

Section<MagnetParameters> magnet_section() {
  using P = MagnetParameters;
  Section<P> s("magnet", "Magnetic bearing that holds the rotor until its release.");
  s.integer("node", &P::node, {.range = at_least(1), .help = "Rotor node at which it acts, numbered from 1."});
  s.matrix("stiffness", &P::stiffness,
           {.unit = "N/m",
            .usual = between(-1e10, 1e10),
            .help = "[[K_yy, K_yz], [K_zy, K_zz]] of magnet and control until the release: force on the rotor = F_0 - "
                    "K x - C v, "
                    "with x from where the rotor starts."});
  s.matrix("damping", &P::damping,
           {.unit = "N s/m", .fallback = {{"0", "0"}, {"0", "0"}}, .help = "[[C_yy, C_yz], [C_zy, C_zz]], likewise."});
  s.quantities(
      "release_time", &P::release_time,
      {.unit = "s",
       .range = at_least(0),
       .fallback = {"0 s", "0 s"},
       .help = "When it lets go along y and along z: one axis, or one magnet, may go first. 0: at the start."});
  s.quantity(
      "residual_time_constant", &P::residual_time,
      {.unit = "s",
       .range = at_least(0),
       .usual = or_zero(between(1e-5, 0.2)),
       .fallback = "0 s",
       .help = "With it the force that held the rotor decays after the release, as currents die away; 0: at once."});
  s.quantities(
      "holding_force", &P::holding_force,
      {.unit = "N",
       .help = "F_0 along y, z, with the rotor at rest in the middle of the touchdown bearings. A disturbance of "
               "the start (rotor.initial_offset and the like) adds -K x - C v. If not given, the magnets share "
               "what linear supports leave of the rotor's weight by its centre of gravity."});
  s.quantity("axial_stiffness", &P::axial_stiffness,
             {.unit = "N/m",
              .range = at_least(0),
              .usual = or_zero(between(1e3, 1e10)),
              .fallback = "0 N/m",
              .help = "Along the axis, of a rotor with axial_motion = \"free\": a thrust magnet."});
  s.quantity("axial_damping", &P::axial_damping,
             {.unit = "N s/m", .range = at_least(0), .fallback = "0 N s/m", .help = "Likewise."});
  s.quantity("axial_release_time", &P::axial_release_time,
             {.unit = "s", .range = at_least(0), .fallback = "0 s", .help = "When it lets go along the axis."});
  s.quantity("axial_holding_force", &P::axial_holding_force,
             {.unit = "N",
              .help = "F_0 along x; if not given, magnets with an axial stiffness share the axial weight and the axial "
                      "force at the start evenly."});
  s.check([](const P& p, const Node& table, const std::string& path, Faults& faults) {
    for (std::size_t i = 0; i < 2; ++i)
      if (p.release_time[i] > 0. && !(p.stiffness[i][i] > 0.)) {
        faults.add(
            position_of_value(table, "stiffness"),
            path +
                ".stiffness has a diagonal entry that is not above 0. A magnet with a negative stiffness would push "
                "the rotor away while it holds it, and one without stiffness would not keep it in its place.",
            "Give the stiffness of magnet and control together, or release_time = [\"0 s\", \"0 s\"].");
        break;
      }
  });
  return s;
}

MagnetSupport::MagnetSupport(std::string name, const MagnetParameters& parameters, const MagnetStart& start)
    : name_(std::move(name)), p_(parameters), start_(start) {}

std::vector<StateEntry> MagnetSupport::ledger_entries() const {
  return {{"magnet work", "J", 1., "work of the magnet's force on the rotor, with what its damping takes added"}};
}

std::vector<Observable> MagnetSupport::observables() const {
  return {{"magnet_force", "N", "force of the magnet on the rotor", 3, {"x", "y", "z"}}};
}

std::vector<double> MagnetSupport::instants() const {
  return {p_.release_time[0], p_.release_time[1], p_.axial_release_time};
}

void MagnetSupport::evaluate(const SupportInput& in, std::span<const double>, std::span<double>,
                             std::span<double> ledger, SupportOutput& out) const {
  const std::array<double, 2> x = {in.journal.y - start_.centre[1], in.journal.z - start_.centre[2]};
  const std::array<double, 2> v = {in.journal.velocity_y, in.journal.velocity_z};
  const auto residual = [&](double force, double since) {
    return p_.residual_time > 0. ? force * std::exp(-since / p_.residual_time) : 0.;
  };
  std::array<double, 2> force{};
  double loss = 0.;
  for (std::size_t i = 0; i < 2; ++i) {
    const double held = start_.holding_force[1 + i];
    if (in.time >= p_.release_time[i]) {
      force[i] = residual(held, in.time - p_.release_time[i]);
      continue;
    }
    const double damper = p_.damping[i][0] * v[0] + p_.damping[i][1] * v[1];
    force[i] = held - p_.stiffness[i][0] * x[0] - p_.stiffness[i][1] * x[1] - damper;
    loss += damper * v[i];
  }
  const double v_x = in.journal.velocity_x, held = start_.holding_force[0];
  double axial;
  if (in.time >= p_.axial_release_time) {
    axial = residual(held, in.time - p_.axial_release_time);
  } else {
    axial = held - p_.axial_stiffness * (in.journal.x - start_.centre[0]) - p_.axial_damping * v_x;
    loss += p_.axial_damping * v_x * v_x;
  }
  out.force_on_rotor = {};
  out.force_on_rotor.x = axial;
  out.force_on_rotor.y = force[0];
  out.force_on_rotor.z = force[1];
  const double power = axial * v_x + force[0] * v[0] + force[1] * v[1];
  out.other_dissipation = loss;
  out.prescribed_work = power + loss;
  ledger[0] = power + loss;
  if (out.observed.empty()) return;
  out.observed[0] = axial;
  out.observed[1] = force[0];
  out.observed[2] = force[1];
}

std::vector<double> weight_shares(const std::vector<double>& positions, double centre_of_gravity) {
  const auto n = static_cast<double>(positions.size());
  double mean = 0., spread = 0.;
  for (const double x : positions) mean += x / n;
  for (const double x : positions) spread += (x - mean) * (x - mean);
  std::vector<double> shares;
  for (const double x : positions)
    shares.push_back(1. / n + (spread > 0. ? (centre_of_gravity - mean) * (x - mean) / spread : 0.));
  return shares;
}

}  // namespace rotordrop
