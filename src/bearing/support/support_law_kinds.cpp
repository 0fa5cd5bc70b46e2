#include "bearing/support/support_law_kinds.h"

#include <fmt/format.h>

namespace rotordrop {

namespace {

/// Along one axis at least; support_section() asks for both where one law holds for both.
void check_springs(const SupportLawParameters& p, const Node& table, const std::string& path, Faults& faults) {
  if (!p.K_y && !p.K_z) add_missing_key(table, path, "K_y", p.type, faults);
  if (!p.C_y && !p.C_z) add_missing_key(table, path, "C_y", p.type, faults);
}

// An axis without a value of its own is not asked for its force.
std::array<double, 2> pair_of(const std::optional<double>& y, const std::optional<double>& z) {
  return {y ? *y : *z, z ? *z : *y};
}
std::array<double, 2> K(const SupportLawParameters& p) { return pair_of(p.K_y, p.K_z); }
std::array<double, 2> C(const SupportLawParameters& p) { return pair_of(p.C_y, p.C_z); }

std::string springs_text(const SupportLawParameters& p) {
  return fmt::format("springs of {:.4g} and {:.4g} N/m, dampers of {:.4g} and {:.4g} N s/m along y and z", K(p)[0],
                     K(p)[1], C(p)[0], C(p)[1]);
}

SqueezeFilm film_of(const SqueezeFilmParameters& p, const SupportSurroundings& around) {
  return {p.viscosity, p.radius.value_or(around.outer_radius), p.length.value_or(around.width), p.clearance,
          p.cavitates};
}

std::shared_ptr<const SupportLaw> springs_of(const SupportLawParameters& p) {
  return std::make_shared<SpringSupport>(K(p), C(p));
}

bool has_film(const SupportParameters& s) { return s.type == "squeeze-film" && s.squeeze_film; }

MaxwellModel maxwell_of(const ElastomerParameters& p) {
  if (p.model == ElastomerModel::kelvin_voigt) return kelvin_voigt(stiffness_table(p), *p.frequency);
  return fit_maxwell(stiffness_table(p)).model;
}

}  // namespace

const SupportLawKind* law_kind(const std::string& type) {
  for (const auto& kind : support_law_kinds())
    if (kind.type == type) return &kind;
  return nullptr;
}

void add_missing_key(const Node& table, const std::string& path, const std::string& key, const std::string& type,
                     Faults& faults) {
  faults.add(table.where(), fmt::format("{}.{} is missing.", path, key), fmt::format("type = \"{}\" needs it.", type));
}

RibbonSupport::Axis ribbon_axis(const RibbonParameters& p) {
  RibbonSupport::Axis axis;
  if (p.loop) {
    axis = ribbon_from_loop({p.loop->loading, p.loop->unloading});
  } else if (p.geometry) {
    const auto& g = *p.geometry;
    axis = ribbon_from_geometry({g.waves, g.pitch, g.height, g.thickness, g.strip_width, g.interference, g.modulus,
                                 g.poisson_ratio, g.friction_coefficient, g.stick_length});
  } else {
    axis.stiffness = *p.stiffness;
    axis.elements.push_back({*p.stick_stiffness, *p.slip_force / *p.stick_stiffness});
  }
  axis.damping = p.damping;
  return axis;
}

std::vector<DynamicStiffness> stiffness_table(const ElastomerParameters& p) {
  std::vector<DynamicStiffness> table;
  for (std::size_t k = 0; k < p.storage.size(); ++k)
    table.push_back({p.storage[k][0], p.storage[k][1] * p.shape_factor, p.loss[k][1] * p.shape_factor});
  return table;
}

const std::vector<SupportLawKind>& support_law_kinds() {
  using P = SupportLawParameters;
  static const std::vector<SupportLawKind> kinds = {
      {"linear", true, false, check_springs, springs_of, springs_text},
      {"ribbon", false, false,
       [](const P& p, const Node& table, const std::string& path, Faults& faults) {
         if (!p.ribbon) add_missing_key(table, path, "ribbon", p.type, faults);
       },
       [](const P& p) {
         const auto axis = ribbon_axis(*p.ribbon);
         return std::make_shared<RibbonSupport>(axis);
       },
       [](const P& p) {
         const auto axis = ribbon_axis(*p.ribbon);
         std::string sliders;
         for (const auto& s : axis.elements)
           sliders += fmt::format("{}{:.4g} N after {:.4g} um", sliders.empty() ? "" : ", ", s.stiffness * s.reach,
                                  s.reach * 1e6);
         std::string text = fmt::format("ribbon of {:.4g} N/m with friction of {}", axis.stiffness, sliders);
         if (p.ribbon->loop)
           text += fmt::format(
               "; a turn between {:.4g} um loses {:.4g} J, the measured loop {:.4g} J",
               0.5e6 * (p.ribbon->loop->loading.back()[0] - p.ribbon->loop->loading.front()[0]),
               steady_loop_loss(axis, 0.5 * (p.ribbon->loop->loading.back()[0] - p.ribbon->loop->loading.front()[0])),
               loop_area({p.ribbon->loop->loading, p.ribbon->loop->unloading}));
         if (p.ribbon->geometry)
           text += fmt::format("; by geometry, an estimate for travel below {:.4g} um",
                               p.ribbon->geometry->interference * 1e6);
         return text;
       }},
      {"elastomer", false, false,
       [](const P& p, const Node& table, const std::string& path, Faults& faults) {
         if (!p.elastomer) add_missing_key(table, path, "elastomer", p.type, faults);
       },
       [](const P& p) {
         const auto axis = maxwell_of(*p.elastomer);
         return std::make_shared<ElastomerSupport>(std::array{axis, axis});
       },
       [](const P& p) {
         if (p.elastomer->model == ElastomerModel::kelvin_voigt) {
           const auto m = maxwell_of(*p.elastomer);
           return fmt::format("elastomer (Kelvin-Voigt) of {:.4g} N/m and {:.4g} N s/m", m.stiffness, m.damping);
         }
         const auto fit = fit_maxwell(stiffness_table(*p.elastomer));
         return fmt::format(
             "elastomer of {} Maxwell elements, {:.4g} N/m at rest; off its table by {:.2g} at most, at {:.4g} Hz",
             fit.model.elements.size(), fit.model.stiffness, fit.largest_error, fit.worst_frequency);
       }},
      {"squeeze-film", true, true,
       [](const P& p, const Node& table, const std::string& path, Faults& faults) {
         if (!p.squeeze_film) add_missing_key(table, path, "squeeze_film", p.type, faults);
         check_springs(p, table, path, faults);
         if (p.squeeze_film && p.stop && p.stop->gap > p.squeeze_film->clearance)
           faults.add(position_of_value(table, "stop"),
                      fmt::format("{}.stop.gap = {:.4g} um is beyond the film's clearance of {:.4g} um.", path,
                                  p.stop->gap * 1e6, p.squeeze_film->clearance * 1e6),
                      "Metal meets metal where the film is used up.");
       },
       springs_of, springs_text},
      {"bump-stop", true, true,
       [](const P& p, const Node& table, const std::string& path, Faults& faults) {
         check_springs(p, table, path, faults);
         if (!p.stop) add_missing_key(table, path, "stop", p.type, faults);
       },
       springs_of, springs_text}};
  return kinds;
}

bool is_plain(const SupportParameters& s) { return s.type == "linear" && !s.stop && !s.z; }

bool is_soft(const SupportParameters& s) {
  return s.type == "ribbon" || s.type == "elastomer" || s.type == "squeeze-film";
}

std::optional<StopParameters> acting_stop(const SupportParameters& s) {
  if (s.stop || !has_film(s)) return s.stop;
  return StopParameters{(1. - SqueezeFilm::thinnest) * s.squeeze_film->clearance, 1e9, 0.08};
}

std::shared_ptr<const SupportLaw> support_law(const SupportParameters& s, const SupportSurroundings& around) {
  if (is_plain(s)) return nullptr;
  std::shared_ptr<const SupportLaw> law = law_kind(s.type)->make(s);
  if (s.z) law = std::make_shared<SplitSupport>(std::move(law), law_kind(s.z->type)->make(*s.z));
  if (has_film(s)) law = std::make_shared<SqueezeFilmSupport>(std::move(law), film_of(*s.squeeze_film, around));
  if (const auto stop = acting_stop(s))
    law = std::make_shared<StoppedSupport>(std::move(law), stop->gap, HuntCrossley{stop->stiffness, 1., stop->lambda});
  return law;
}

std::string support_words(const SupportParameters& s, const SupportSurroundings& around) {
  if (is_plain(s)) return {};
  std::string text = law_kind(s.type)->describe(s);
  if (s.z) text = "along y " + text + "; along z " + law_kind(s.z->type)->describe(*s.z);
  if (has_film(s)) {
    constexpr double slow = 1e-6;
    const auto centred = film_of(*s.squeeze_film, around).force({0., 0., slow, 0.});
    text += fmt::format("; squeeze film with {:.4g} N s/m when centred", -centred[0] / slow);
  }
  if (s.stop) text += fmt::format("; stop of {:.4g} N/m behind {:.4g} um", s.stop->stiffness, s.stop->gap * 1e6);
  return text;
}

}  // namespace rotordrop
