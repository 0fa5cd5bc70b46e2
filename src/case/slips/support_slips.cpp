#include "case/slips/slips.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>

namespace rotordrop {
namespace {

/// The file that a key is from; in parameters.toml of a run the one that stands behind it.
std::string origin_of(const Node& table, const char* key) {
  constexpr std::string_view from = "from ";
  const Node::Entry* entry = table.entry(key);
  if (!entry) return "";
  const auto at = entry->comment.find(from);
  if (at == std::string::npos) return entry->value.where().file.text();
  return entry->comment.substr(at + from.size(), entry->comment.find(':', at) - at - from.size());
}

/// bearings.NAME.support; the bearing's table if it has none.
const Node& support_table(const Node& tree, const std::string& name) {
  const Node& bearing = table_at(tree, "bearings", name);
  const Node* own = bearing.find("support");
  return own ? *own : bearing;
}

/// An outer ring with its housing, against the inner ring and the rotor.
void look_at_mass(const std::string& name, const TouchdownParameters& b, double rotor_mass, const Node& tree,
                  std::vector<Fault>& warnings) {
  // Estimates: an outer ring weighs about as much as the inner one, and a machine frame is no part of one support.
  constexpr double lightest = 0.3, heaviest = 5.;
  const double mass = b.support.mass;
  const bool is_light = mass < lightest * b.ring_mass;
  if (is_light || mass > heaviest * rotor_mass)
    warn(warnings, position_of_value(support_table(tree, name), "mass"),
         fmt::format("bearings.{}.support.mass = {:.4g} kg is {:.3g} times {}.", name, mass,
                     mass / (is_light ? b.ring_mass : rotor_mass), is_light ? "the inner ring's" : "the rotor's"),
         "It is the mass that moves with the outer ring: the ring, and the housing if that moves. A bare number is in "
         "kg.");
}

/// Springs and dampers against the mass that they carry.
void look_at_support(const std::string& name, const SupportParameters& support, const Node& tree,
                     std::vector<Fault>& warnings) {
  constexpr double least_damping = 1e-4, most_damping = 3.;  // of critical; estimates, with a margin
  const Node& own = support_table(tree, name);
  const bool has_springs = support.type != "ribbon" && support.type != "elastomer";
  // Of a layer below that of the type it is what the type replaces.
  const Node* type = own.find("type");
  const auto is_meant = [&](const char* key) {
    const std::string file = origin_of(own, key);
    return !type || file == origin_of(own, "type") || file == tree.where().file.text() || file.starts_with("--set");
  };
  const auto without_effect = [&](const char* key) {
    if (!is_meant(key)) return;
    warn(warnings, position_of_value(own, key),
         fmt::format("bearings.{}.support.{} has no effect with type = \"{}\".", name, key, support.type),
         "Set the type that is meant, or take the key out.");
  };
  for (const auto& [key, is_given] : {std::pair{"K_y", support.K_y.has_value()},
                                      {"K_z", support.K_z.has_value()},
                                      {"C_y", support.C_y.has_value()},
                                      {"C_z", support.C_z.has_value()}})
    if (is_given && !has_springs) without_effect(key);
  if (support.ribbon && support.type != "ribbon") without_effect("ribbon");
  if (support.elastomer && support.type != "elastomer") without_effect("elastomer");
  if (support.squeeze_film && support.type != "squeeze-film") without_effect("squeeze_film");
  for (const auto& [key, K, C] : {std::tuple{"C_y", support.K_y, support.C_y}, {"C_z", support.K_z, support.C_z}}) {
    if (!K || !C || *C == 0.) continue;
    const double ratio = *C / (2. * std::sqrt(*K * support.mass));
    if (ratio < least_damping || ratio > most_damping)
      warn(warnings, position_of_value(own, key),
           fmt::format("bearings.{}.support.{} = {:.6g} N s/m is {:.3g} of critical damping of its mass and stiffness; "
                       "most often it is between {:.4g} and {:.4g}.",
                       name, key, *C, ratio, least_damping, most_damping),
           "Critical is 2 sqrt(K m). A bare number is in N s/m. Check mass and stiffness, too.");
  }
}

/// A film or a ribbon around the outer ring, against its dimensions.
void look_at_ring_seat(const std::string& name, const TouchdownParameters& b, const Node& tree,
                       std::vector<Fault>& warnings) {
  const Node& own = support_table(tree, name);
  const double radius = 0.5 * b.outer_ring_diameters[1];
  if (const auto& film = b.support.squeeze_film) {
    const Node& table = table_at(own, "squeeze_film");
    if (film->radius && (*film->radius < 0.5 * radius || *film->radius > 3. * radius))
      warn(warnings, position_of_value(table, "radius"),
           fmt::format("bearings.{}.support.squeeze_film.radius = {:.4g} mm is {:.3g} times the outer ring's, {:.4g} "
                       "mm.",
                       name, mm(*film->radius), *film->radius / radius, mm(radius)),
           "The film lies around the outer ring. It is a radius; a bare number is in metres.");
    if (film->length && (*film->length < 0.1 * b.width || *film->length > 5. * b.width))
      warn(warnings, position_of_value(table, "length"),
           fmt::format("bearings.{}.support.squeeze_film.length = {:.4g} mm, but the bearing is {:.4g} mm wide.", name,
                       mm(*film->length), mm(b.width)),
           "Damping grows with its cube. A bare number is in metres.");
  }
  if (const auto& ribbon = b.support.ribbon; ribbon && ribbon->geometry) {
    const auto& g = *ribbon->geometry;
    const auto tell = [&](const std::string& what, const char* advice) {
      warn(warnings, position_of_value(table_at(own, "ribbon"), "geometry"),
           fmt::format("bearings.{}.support.ribbon.geometry has {}.", name, what), advice);
    };
    const double around = 2. * std::numbers::pi * radius, waves = g.waves * g.pitch;
    if (waves < 0.3 * around || waves > 1.2 * around)
      tell(fmt::format("{} waves of {:.4g} mm: {:.4g} mm, but around the outer ring there are {:.4g} mm", g.waves,
                       mm(g.pitch), mm(waves), mm(around)),
           "Check waves and pitch; a bare number is in metres.");
    if (g.strip_width > 2. * b.width || g.strip_width < 0.05 * b.width)
      tell(fmt::format("a strip_width of {:.4g} mm, but the bearing is {:.4g} mm wide", mm(g.strip_width), mm(b.width)),
           "It is along the axis. A bare number is in metres.");
    if (g.thickness > 0.5 * g.height)
      tell(fmt::format("a thickness of {:.4g} mm, but waves of {:.4g} mm height", mm(g.thickness), mm(g.height)),
           "The formulas are those of a thin strip; stiffness grows with the cube of its thickness.");
    if (g.interference > 0.5 * g.height)
      tell(fmt::format("an interference of {:.4g} mm, but waves of {:.4g} mm height: mounting would flatten them",
                       mm(g.interference), mm(g.height)),
           "It is radial. A bare number is in metres.");
  }
}

/// Smallest eigenvalue of the symmetric part: what the softest direction feels.
double least_of(const LinearSupport::Matrix& K) {
  return 0.5 * (K[0][0] + K[1][1] - std::hypot(K[0][0] - K[1][1], K[0][1] + K[1][0]));
}

/// Of a matrix with no negative entry on its diagonal: whether one direction between the axes has a negative value.
bool is_negative_between_axes(const LinearSupport::Matrix& K) {
  constexpr double rounding = 1e-12;
  return K[0][0] >= 0. && K[1][1] >= 0. && least_of(K) < -rounding * (K[0][0] + K[1][1]);
}

/// Springs and dampers between rotor and ground: y against z, damping against stiffness.
void look_at_matrices(const std::string& name, const LinearSupport::Matrix& K, const LinearSupport::Matrix& C,
                      double mass, const Node& tree, std::vector<Fault>& warnings) {
  constexpr double most_unequal = 100., most_damping = 10.;  // estimates, of critical with the rotor's mass
  const Node& table = table_at(tree, "bearings", name);
  const double stiffer = std::max(K[0][0], K[1][1]), softer = std::min(K[0][0], K[1][1]);
  if (softer > 0. && stiffer > most_unequal * softer)
    warn(warnings, position_of_value(table, "stiffness"),
         fmt::format("bearings.{}.stiffness has {:.4g} and {:.4g} N/m on its diagonal: one is {:.3g} times the other.",
                     name, K[0][0], K[1][1], stiffer / softer),
         "Check the units of both.");
  if (is_negative_between_axes(K))
    warn(warnings, position_of_value(table, "stiffness"),
         fmt::format("bearings.{}.stiffness has {:.4g} N/m in its softest direction, between y and z: it pushes the "
                     "rotor away.",
                     name, least_of(K)),
         "K_yz + K_zy is too large for the diagonal. Cross coupling of a fluid film has K_zy = -K_yz.");
  if (is_negative_between_axes(C))
    warn(warnings, position_of_value(table, "damping"),
         fmt::format("bearings.{}.damping has {:.4g} N s/m in one direction between y and z: it drives the rotor.",
                     name, least_of(C)),
         "C_yz + C_zy is too large for the diagonal.");
  for (std::size_t i = 0; i < 2; ++i)
    if (const double critical = K[i][i] > 0. ? 2. * std::sqrt(K[i][i] * mass) : 0.;
        critical > 0. && C[i][i] > most_damping * critical)
      warn(warnings, position_of_value(table, "damping"),
           fmt::format("bearings.{}.damping = {:.4g} N s/m is {:.3g} times critical damping of the rotor on it.", name,
                       C[i][i], C[i][i] / critical),
           "Critical is 2 sqrt(K m). A bare number is in N s/m: 10 N s/mm are 10000.");
}

/// A spring that pushes the rotor away, or does not hold it.
void look_at_springs(const std::string& name, const LinearSupportParameters& support, const Node& tree,
                     std::vector<Fault>& warnings) {
  const auto& K = support.stiffness;
  const Node& table = table_at(tree, "bearings", name);
  for (std::size_t i = 0; i < 2; ++i)
    if (K[i][i] < 0.)
      warn(warnings, position_of_value(table, "stiffness"),
           fmt::format("bearings.{}.stiffness = {:.4g} N/m on its diagonal pushes the rotor away.", name, K[i][i]),
           "Stiffness is positive: force on the rotor = -K x. A magnet without control may be meant.");
  const double cross = std::max(std::fabs(K[0][1]), std::fabs(K[1][0]));
  const double direct = std::max(std::fabs(K[0][0]), std::fabs(K[1][1]));
  if (cross > 10. * direct)
    warn(warnings, position_of_value(table, "stiffness"),
         fmt::format("bearings.{}.stiffness couples y and z with {:.4g} N/m, but has {:.4g} N/m on its diagonal.", name,
                     cross, direct),
         "It is [[K_yy, K_yz], [K_zy, K_zz]].");
  for (std::size_t i = 0; i < 2; ++i)
    if (support.damping[i][i] < 0.)
      warn(warnings, position_of_value(table, "damping"),
           fmt::format("bearings.{}.damping = {:.4g} N s/m on its diagonal drives the rotor.", name,
                       support.damping[i][i]),
           "Damping is positive: force on the rotor = -C v.");
}

/// A ribbon of numbers: what its friction adds to its springs, and how far it holds.
void look_at_slider(const std::string& name, const RibbonParameters& ribbon, const Node& own,
                    std::vector<Fault>& warnings) {
  if (!ribbon.stick_stiffness || !ribbon.slip_force) return;
  // Estimates: measured loops stick for some micrometres, at several times the stiffness that is left when they slip.
  constexpr double least_travel = 0.1e-6, least_ratio = 0.1;
  if (const double travel = *ribbon.slip_force / *ribbon.stick_stiffness; travel < least_travel)
    warn(warnings, position_of_value(own, "ribbon"),
         fmt::format("bearings.{}.support.ribbon slips after {:.3g} um (slip_force over stick_stiffness); most often "
                     "it holds for some micrometres.",
                     name, travel * 1e6),
         "Bare numbers are in N and N/m: 1.2 kN are 1200.");
  if (const double ratio = *ribbon.stick_stiffness / *ribbon.stiffness; ratio < least_ratio)
    warn(warnings, position_of_value(own, "ribbon"),
         fmt::format("bearings.{}.support.ribbon.stick_stiffness = {:.4g} N/m is {:.3g} times its stiffness, {:.4g} "
                     "N/m; most often it is several times as much.",
                     name, *ribbon.stick_stiffness, ratio, *ribbon.stiffness),
         "It is what friction adds until it slips. A bare number is in N/m.");
}

/// How far the rotor's weight moves the outer rings, where springs or a ribbon of numbers carry them.
void look_at_sag(const std::string& name, const TouchdownParameters& b, double share, const CaseParameters& p,
                 const Node& tree, std::vector<Fault>& warnings) {
  const SupportParameters& support = b.support;
  const Node& own = support_table(tree, name);
  const double gap = air_gap(b, p.contact);
  const bool is_ribbon = support.type == "ribbon" && support.ribbon && support.ribbon->stiffness;
  const auto compare = [&](const char* key, double K, double gravity) {
    const double sag = share * std::fabs(gravity) / K;
    if (sag > gap)
      warn(warnings, position_of_value(own, is_ribbon ? "ribbon" : key),
           fmt::format("bearings.{}.support.{} = {:.4g} N/m gives way by {:.4g} mm under this bearing's share of the "
                       "rotor's weight, more than the air gap, {:.4g} mm.",
                       name, is_ribbon ? "ribbon.stiffness" : key, K, mm(sag), mm(gap)),
           "A bare number is in N/m: outer rings sit on 1e6 to 1e10 N/m.");
  };
  const auto& g = p.run.gravity;
  if (is_ribbon) {
    // Estimates: impacts of a drop press with some ten times the weight; a ribbon is there to slip in them, not under any load.
    constexpr double most_slip = 20., least_slip = 0.02;
    // Until it slips it has its stick stiffness.
    const double weight = share * std::hypot(g[1], g[2]);
    if (!support.ribbon->slip_force || weight > *support.ribbon->slip_force)
      compare("stiffness", *support.ribbon->stiffness, std::hypot(g[1], g[2]));
    if (support.ribbon->slip_force && weight > 0. &&
        (*support.ribbon->slip_force > most_slip * weight || *support.ribbon->slip_force < least_slip * weight))
      warn(warnings, position_of_value(own, "ribbon"),
           fmt::format("bearings.{}.support.ribbon.slip_force = {:.4g} N is {:.3g} times this bearing's share of the "
                       "rotor's weight: it {} slips.",
                       name, *support.ribbon->slip_force, *support.ribbon->slip_force / weight,
                       *support.ribbon->slip_force > weight ? "never" : "always"),
           "A bare number is in N.");
    look_at_slider(name, *support.ribbon, own, warnings);
    return;
  }
  if (support.type == "elastomer" && support.elastomer && !support.elastomer->storage.empty())
    if (const double K = support.elastomer->storage.front()[1] * support.elastomer->shape_factor;
        K > 0. && share * std::hypot(g[1], g[2]) / K > gap)
      warn(warnings, position_of_value(own, "elastomer"),
           fmt::format("bearings.{}.support.elastomer gives way by {:.4g} mm under this bearing's share of the rotor's "
                       "weight ({:.4g} N/m at its lowest frequency), more than the air gap, {:.4g} mm.",
                       name, mm(share * std::hypot(g[1], g[2]) / K), K, mm(gap)),
           "Stiffness is storage times shape_factor. Bare numbers are in Pa and in metres.");
  // Estimate: O-rings have 1e6 to 1e8 N/m (Smalley, Darlow & Mehta 1978); three times as much is for thick layers.
  constexpr double stiffest_elastomer = 3e8;
  if (support.type == "elastomer" && support.elastomer && !support.elastomer->storage.empty())
    if (const double K = support.elastomer->storage.front()[1] * support.elastomer->shape_factor;
        K > stiffest_elastomer)
      warn(warnings, position_of_value(own, "elastomer"),
           fmt::format("bearings.{}.support.elastomer has {:.3g} N/m at its lowest frequency; O-rings have 1e6 to 1e8 "
                       "N/m.",
                       name, K),
           "Stiffness is storage times shape_factor. Bare numbers are in Pa and in metres.");
  if (support.K_y) compare("K_y", *support.K_y, g[1]);
  if (support.K_z) compare("K_z", *support.K_z, g[2]);
  if (support.K_y && support.K_z && (*support.K_y > 100. * *support.K_z || *support.K_z > 100. * *support.K_y))
    warn(warnings, position_of_value(own, "K_y"),
         fmt::format("bearings.{}.support has K_y = {:.4g} and K_z = {:.4g} N/m: one is {:.3g} times the other.", name,
                     *support.K_y, *support.K_z,
                     std::max(*support.K_y, *support.K_z) / std::min(*support.K_y, *support.K_z)),
         "Check the units of both.");
}

/// A rotor that one bearing holds after its magnets have let go.
void look_at_tipping(const CaseParameters& p, const RigidBody& body, const Node& tree, std::vector<Fault>& warnings) {
  // Of the rotor's length: what a rotor balances on for the time of a drop. Estimate.
  constexpr double nearly_at = 0.01;
  const SupportEntry* only = nullptr;
  for (const auto& entry : p.bearings) {
    if (const auto* m = entry.magnet(); m && std::min(m->release_time[0], m->release_time[1]) < p.run.latest_end())
      continue;
    if (only && only->node() != entry.node()) return;
    if (!only || entry.touchdown()) only = &entry;
  }
  if (!only || !only->touchdown() || only->touchdown()->ring_motion == RingMotion::free) return;
  for (const auto& [name, probe] : p.rotor.probes)
    if (probe.contact && probe.node != only->node()) return;
  const auto& x = p.rotor.geometry.node_x;
  const double length = x.empty() ? 0. : x.back() - x.front(),
               beside = p.rotor.geometry.position(only->node()) - body.centre_of_gravity;
  if (std::fabs(beside) <= nearly_at * length || std::hypot(p.run.gravity[1], p.run.gravity[2]) == 0.) return;
  warn(warnings, position_of_value(table_at(tree, "bearings", only->name), "node"),
       fmt::format("bearings.{} alone holds the rotor, {:.4g} mm beside its centre of gravity: the rotor tips over.",
                   only->name, mm(std::fabs(beside))),
       "A rotor needs touchdown bearings at two places, on both sides of its centre of gravity. Is one missing, or its "
       "node or a mass of the rotor wrong?");
}

}  // namespace

void look_at_supports(const CaseParameters& p, const Node& tree, std::vector<Fault>& warnings) {
  const RigidBody body = rigid_body(p.rotor.geometry);
  std::vector<const SupportEntry*> touchdowns;
  std::vector<double> positions;
  for (const auto& entry : p.bearings)
    if (entry.touchdown()) {
      touchdowns.push_back(&entry);
      positions.push_back(p.rotor.geometry.position(entry.node()));
    }
  const auto shares = weight_shares(positions, body.centre_of_gravity);
  for (std::size_t i = 0; i < touchdowns.size(); ++i) {
    const auto& b = *touchdowns[i]->touchdown();
    look_at_mass(touchdowns[i]->name, b, body.mass, tree, warnings);
    look_at_support(touchdowns[i]->name, b.support, tree, warnings);
    look_at_ring_seat(touchdowns[i]->name, b, tree, warnings);
    look_at_sag(touchdowns[i]->name, b, body.mass * std::fabs(shares[i]), p, tree, warnings);
  }
  for (const auto& entry : p.bearings)
    if (const auto* linear = entry.linear()) {
      look_at_springs(entry.name, *linear, tree, warnings);
      look_at_matrices(entry.name, linear->stiffness, linear->damping, body.mass, tree, warnings);
    } else if (const auto* magnet = entry.magnet()) {
      look_at_matrices(entry.name, magnet->stiffness, magnet->damping, body.mass, tree, warnings);
    }
  look_at_magnets(p, body, tree, warnings);
  look_at_tipping(p, body, tree, warnings);
}

}  // namespace rotordrop
