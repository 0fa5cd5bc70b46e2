#include "thermal/fe/vtu_output.h"

#include <deal.II/numerics/data_out.h>

#include <fstream>

#include "base/errors.h"

namespace rotordrop {

void write_heat_vtu(const HeatOperator& problem, const HeatOperator::Vector& T, double time, const std::string& file) {
  const auto& dofs = problem.mesh().dofs();
  dealii::Vector<double> field(dofs.n_dofs()), rise(dofs.n_dofs());
  for (unsigned int i = 0; i < field.size(); ++i) {
    field(i) = T(i);
    rise(i) = T(i) - problem.problem().initial_temperature;
  }
  dealii::Vector<float> body(static_cast<unsigned int>(problem.n_cells()));
  for (std::size_t i = 0; i < problem.n_cells(); ++i)
    body(static_cast<unsigned int>(i)) = static_cast<float>(problem.mesh().cells()[i]->material_id());

  dealii::DataOut<2> out;
  dealii::DataOutBase::VtkFlags flags;
  flags.time = time;
  flags.compression_level = dealii::DataOutBase::VtkFlags::best_speed;
  out.set_flags(flags);
  out.attach_dof_handler(dofs);
  out.add_data_vector(field, "temperature_K");
  out.add_data_vector(rise, "temperature_rise_K");
  out.add_data_vector(body, "body");
  out.build_patches(problem.mesh().mapping(), problem.mesh().element().degree, dealii::DataOut<2>::curved_boundary);
  std::ofstream stream(file);
  out.write_vtu(stream);
  stream.close();
  if (!stream) throw SolverError("the field cannot be written to " + file + ".");
}

}  // namespace rotordrop
