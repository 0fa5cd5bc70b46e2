#include "study/heat/heat_displacements.h"

#include <nlohmann/json.hpp>

#include "case/modules/fe_module.h"

namespace rotordrop {

HeatDisplacements::HeatDisplacements(const HeatElasticStudy& study, const HeatConductionSolver& conduction)
    : study_(study), displacements_(study.displacements.size()), fits_(study.problem.fits.size()) {
  ElasticProblem problem = study.problem;
  problem.mesh = conduction.section_mesh();
  solver_ = make_elastic_solver(problem);
}

void HeatDisplacements::observe(const HeatConductionSolver& conduction, std::vector<double>& row) {
  solver_->solve(conduction.field(), 0.);
  for (std::size_t i = 0; i < study_.displacements.size(); ++i) {
    const auto& place = study_.displacements[i];
    const AxialRadial u = place.boundary ? solver_->mean_displacement({*place.boundary})
                                         : solver_->displacement(place.body, place.x, place.r);
    displacements_[i].push_back(u);
    row.insert(row.end(), u.begin(), u.end());
  }
  for (std::size_t k = 0; k < fits_.size(); ++k) {
    FitState fit = solver_->fit(k);
    fit.points.clear();
    row.insert(row.end(), {fit.mean_pressure, fit.open_fraction});
    fits_[k].push_back(std::move(fit));
  }
}

void HeatDisplacements::report(const std::vector<double>& times, nlohmann::ordered_json& to) const {
  to["displacements"] = nlohmann::ordered_json::object();
  for (std::size_t i = 0; i < displacements_.size(); ++i) {
    std::vector<double> axial, radial;
    for (const auto& u : displacements_[i]) {
      axial.push_back(u[0]);
      radial.push_back(u[1]);
    }
    to["displacements"][study_.displacements[i].name] = {{"time", times}, {"axial", axial}, {"radial", radial}};
  }
  if (!fits_.empty()) to["fits"] = nlohmann::ordered_json::object();
  for (std::size_t k = 0; k < fits_.size(); ++k) {
    std::vector<double> pressure, open;
    for (const auto& fit : fits_[k]) {
      pressure.push_back(fit.mean_pressure);
      open.push_back(fit.open_fraction);
    }
    to["fits"][study_.problem.fits[k].name] = {{"time", times}, {"mean_pressure", pressure}, {"open_fraction", open}};
  }
}

void append_displacement_channels(const HeatElasticStudy& study, std::vector<Channel>& channels) {
  for (const auto& place : study.displacements)
    channels.push_back({"/displacements/" + place.name,
                        "m",
                        place.boundary ? "mean displacement of a boundary" : "displacement at a point",
                        2,
                        {"axial", "radial"}});
  for (const auto& fit : study.problem.fits) {
    channels.push_back({"/fits/" + fit.name + "/mean_pressure", "Pa", "force across a fit over its area", 1, {}});
    channels.push_back({"/fits/" + fit.name + "/open_fraction", "1", "part of a fit's area that is open", 1, {}});
  }
}

}  // namespace rotordrop
