// The field's file is read back by tests/cli/test_fields.py; here that its faults are told.
#include <gtest/gtest.h>

#include "base/errors.h"
#include "fe_room.h"

namespace rotordrop {
namespace {

TEST(FieldFile, InAFolderThatIsNotThereIsAnError) {
  HeatConductionProblem p;
  p.bodies = {{"ring", {0., 20e-3}, {35e-3, 40e-3}, 7800., PropertyTable(46.), PropertyTable(460.)}};
  EXPECT_THROW(make_solver(p)->write_vtu("no/such/folder/field.vtu"), SolverError);
}

}  // namespace
}  // namespace rotordrop
