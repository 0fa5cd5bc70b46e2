#include "thermal/fe/vtu_output.h"

#include <deal.II/numerics/data_out.h>

#include <fstream>
#include <sstream>
#include <string>

#include "base/errors.h"

namespace rotordrop {
namespace {

// deal.II takes no blanks nor brackets in names; in the file they are attributes in plain text.
std::string with_units(std::string text) {
  const auto replace = [&text](const std::string& from, const std::string& to) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
      text.replace(at, from.size(), to);
  };
  replace("\"temperature_rise_K\"", "\"temperature rise [K]\"");
  replace("\"temperature_K\"", "\"temperature [K]\"");
  return text;
}

}  // namespace

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
  flags.print_date_and_time = false;  // the same field is the same file
  flags.compression_level = dealii::DataOutBase::VtkFlags::best_speed;
  out.set_flags(flags);
  out.attach_dof_handler(dofs);
  out.add_data_vector(field, "temperature_K");
  out.add_data_vector(rise, "temperature_rise_K");
  out.add_data_vector(body, "body");
  out.build_patches(problem.mesh().mapping(), problem.mesh().element().degree, dealii::DataOut<2>::curved_boundary);
  std::ostringstream text;
  out.write_vtu(text);
  std::ofstream stream(file);
  stream << with_units(text.str());
  stream.close();
  if (!stream) throw SolverError("the field cannot be written to " + file + ".");
}

}  // namespace rotordrop
