#include "rotor/rotor_parameters.h"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

namespace rotordrop {
namespace {

/// JSON as the tree of values that io makes of a file; every value is given a line of its own, in the order of reading.
Node to_node(const nlohmann::ordered_json& json, int& line) {
  const SourcePosition where{"rotor.json", ++line, 1};
  if (json.is_object()) {
    Node table = Node::table(where);
    for (const auto& [key, value] : json.items()) {
      const SourcePosition where_key{"rotor.json", line + 1, 1};
      table.set(key, to_node(value, line), where_key);
    }
    return table;
  }
  if (json.is_array()) {
    Node::Array items;
    for (const auto& item : json) items.push_back(to_node(item, line));
    return Node::array(std::move(items), where);
  }
  if (json.is_string()) return Node(json.get<std::string>(), where);
  if (json.is_number_integer()) return Node(json.get<std::int64_t>(), where);
  return Node(json.get<double>(), where);
}
Node to_node(const nlohmann::ordered_json& json) {
  int line = 0;
  return to_node(json, line);
}

nlohmann::ordered_json small_rotor() {
  return nlohmann::ordered_json::parse(R"({
    "material": {"E": 2e11, "nu": 0.3, "rho": 7850},
    "materials": {"aluminium": {"E": 7e10, "nu": 0.33, "rho": 2700}},
    "nodes": [{"id": 1, "x": 0.0}, {"id": 2, "x": "100 mm"}, {"id": 3, "x": 0.3}],
    "elements": [
      {"n1": 1, "n2": 2, "length": 0.1, "od": 0.05},
      {"n1": 1, "n2": 2, "od": 0.09, "id_": 0.05, "material": "aluminium"},
      {"n1": 2, "n2": 3, "od": "40 mm", "id_": 0.02}
    ],
    "mass_points": [{"node": 3, "mass": 2.0, "Ip": 0.01, "Id": 0.006}]
  })");
}

/// All faults of a geometry as one text.
std::string faults_of(const nlohmann::ordered_json& json) {
  Faults faults;
  (void)read_rotor_geometry(to_node(json), faults);
  std::string text;
  for (const auto& fault : faults) text += rendered(fault) + "\n";
  return text;
}

#define EXPECT_SAYS(text, words) EXPECT_NE((text).find(words), std::string::npos) << (text)

TEST(RotorGeometry, IsReadFromTheReferenceFile) {
  std::ifstream file(ROTORDROP_SOURCE_DIR "/params/neisi2019-rotor.json");
  Faults faults;
  const RotorGeometry geometry = read_rotor_geometry(to_node(nlohmann::ordered_json::parse(file)), faults);
  faults.throw_if_any();
  EXPECT_EQ(geometry.n_nodes(), 31);
  EXPECT_EQ(geometry.elements.size(), 30U);
  EXPECT_EQ(geometry.mass_points.size(), 9U);
  EXPECT_NEAR(rigid_body(geometry).mass, 109.6997, 1e-4) << "kg";
}

TEST(RotorGeometry, HasSleevesSeveralMaterialsAndUnits) {
  Faults faults;
  const RotorGeometry geometry = read_rotor_geometry(to_node(small_rotor()), faults);
  faults.throw_if_any();
  EXPECT_DOUBLE_EQ(geometry.node_x[1], 0.1);
  EXPECT_DOUBLE_EQ(geometry.elements[1].material.rho, 2700);
  EXPECT_DOUBLE_EQ(geometry.elements[2].material.rho, 7850);
  EXPECT_DOUBLE_EQ(geometry.elements[2].od, 0.04);
  EXPECT_DOUBLE_EQ(geometry.mass_points[0].Id, 0.006);
}

TEST(RotorGeometry, NamesNodesOutOfOrder) {
  auto json = small_rotor();
  json["nodes"][2]["x"] = 0.1;
  EXPECT_SAYS(faults_of(json), "x = 0.1 m of node 3 is not larger than x = 0.1 m of node 2.");
  EXPECT_SAYS(faults_of(json), "error: rotor.json:");
  json["nodes"][2]["id"] = 4;
  EXPECT_SAYS(faults_of(json), "node id = 4 is at position 3 of the list, where 3 is expected.");
}

TEST(RotorGeometry, NamesElementsThatDoNotFitTheirNodes) {
  auto json = small_rotor();
  json["elements"][0]["length"] = 0.11;
  json["elements"][1]["n2"] = 3;
  json["elements"][2]["n2"] = 7;
  const auto text = faults_of(json);
  EXPECT_SAYS(text, "length = 0.11 m of element 1 (nodes 1 to 2) does not fit its nodes, which are 0.1 m apart.");
  EXPECT_SAYS(text, "element 2 (nodes 1 to 3) does not join a node and the next one.");
  EXPECT_SAYS(text, "n2 = 7 of element 3 (nodes 2 to 7): the rotor has nodes 1 to 3.");
  json = small_rotor();
  json["elements"][0]["n1"] = 2;
  json["elements"][0]["n2"] = 1;
  EXPECT_SAYS(faults_of(json), "Exchange n1 and n2: n1 = 1, n2 = 2.");
}

TEST(RotorGeometry, NamesABoreThatIsNotInsideItsShaft) {
  auto json = small_rotor();
  json["elements"][2]["id_"] = 0.04;
  EXPECT_SAYS(faults_of(json), "id_ = 0.04 m of element 3 (nodes 2 to 3) is not smaller than its od = 0.04 m.");
  json["elements"][2]["id_"] = -0.01;
  EXPECT_SAYS(faults_of(json), "id_");
}

TEST(RotorGeometry, NamesAGapInTheShaftAndTwoElementsInOnePlace) {
  auto json = small_rotor();
  json["elements"].erase(2);
  EXPECT_SAYS(faults_of(json), "no element joins node 2 and node 3.");
  json = small_rotor();
  json["elements"][1]["id_"] = 0.045;
  EXPECT_SAYS(faults_of(json), "two elements between node 1 and node 2 fill the same space");
}

TEST(RotorGeometry, NamesUnknownMaterialsAndNodes) {
  auto json = small_rotor();
  json["elements"][1]["material"] = "aluminum";
  json["mass_points"][0]["node"] = 5;
  json["mass_points"][0]["name"] = "gear";
  auto text = faults_of(json);
  EXPECT_SAYS(text, "element 2 (nodes 1 to 2) is made of \"aluminum\", which `materials` does not have.");
  EXPECT_SAYS(text, "Did you mean \"aluminium\"?");
  EXPECT_SAYS(text, "node = 5 of mass point \"gear\": the rotor has nodes 1 to 3.");
  json = small_rotor();
  json.erase("material");
  EXPECT_SAYS(faults_of(json), "element 1 (nodes 1 to 2) and 1 other name no material, and there is no default `material`.");
}

TEST(RotorGeometry, NamesUnknownKeysAndMissingOnes) {
  auto json = small_rotor();
  json["elements"][0]["odd"] = 1;
  json["nodes"][1].erase("x");
  const auto text = faults_of(json);
  EXPECT_SAYS(text, "unknown key \"odd\"");
  EXPECT_SAYS(text, "nodes#2");
  Faults faults;
  EXPECT_EQ(read_rotor_geometry(Node::table(), faults).n_nodes(), 0);
  EXPECT_EQ(faults.size(), 2U) << "nodes and elements";
}

TEST(RotorSection, HasDefaultsForAllButTheGeometry) {
  Faults faults;
  Node table = Node::table();
  table.set("geometry", Node("rotor.json", {"case.toml", 3, 12}));
  const auto parameters = rotor_section().read(table, faults);
  faults.throw_if_any();
  EXPECT_EQ(parameters.geometry_file, "rotor.json");
  EXPECT_EQ(parameters.geometry_position.line, 3);
  const auto settings = rotor_settings(parameters, {0., -9.81, 0.});
  EXPECT_EQ(settings.representation, RotorRepresentation::modal);
  EXPECT_DOUBLE_EQ(settings.cut_off_frequency, 4500);
  EXPECT_DOUBLE_EQ(settings.modal_damping, 0.005);
  EXPECT_DOUBLE_EQ(settings.gravity_y, -9.81);
  EXPECT_TRUE(settings.drive_torque.empty());
  EXPECT_EQ(initial_disturbance(parameters).velocity_z, 0);

  Faults without_geometry;
  (void)rotor_section().read(Node::table(), without_geometry);
  ASSERT_EQ(without_geometry.size(), 1U);
  EXPECT_SAYS(without_geometry.begin()->message, "geometry");
}

TEST(RotorSection, ReadsEverything) {
  Node table = Node::table(
      {{"geometry", to_node(small_rotor())},
       {"model", "rigid"},
       {"modal_damping", 0.01},
       {"mass_proportional_alpha", "30 1/s"},
       {"cut_off_frequency", "2 kHz"},
       {"unbalance", Node::array({Node::table({{"node", 3}, {"me", 1.07e-6}, {"angle", "180 deg"}})})},
       {"torque", Node::array({Node::array({Node(0), Node("1 N m")}), Node::array({Node("500 ms"), Node(-3)})})},
       {"initial_offset", Node::array({Node("10 um"), Node(0)})},
       {"initial_tilt", Node::array({Node(0), Node(1e-4)})},
       {"initial_velocity", Node::array({Node(0.1), Node(0.2)})},
       {"initial_tilt_rate", Node::array({Node(0.3), Node(0)})},
       {"initial_orbit", Node::table({{"radius", "100 um"}, {"angle", "90 deg"}, {"speed", 100.0}})}});
  Faults faults;
  const auto parameters = rotor_section().read(table, faults);
  faults.throw_if_any();
  const auto settings = rotor_settings(parameters, {0., -9.81, 0.});
  EXPECT_EQ(settings.representation, RotorRepresentation::rigid);
  EXPECT_DOUBLE_EQ(settings.cut_off_frequency, 2000);
  EXPECT_DOUBLE_EQ(settings.mass_proportional_alpha, 30);
  ASSERT_EQ(settings.unbalance.size(), 1U);
  EXPECT_DOUBLE_EQ(settings.unbalance[0].angle, std::numbers::pi);
  ASSERT_EQ(settings.drive_torque.size(), 2U);
  EXPECT_DOUBLE_EQ(settings.drive_torque[1][0], 0.5);
  EXPECT_DOUBLE_EQ(settings.drive_torque[1][1], -3);
  const Motion start = initial_disturbance(parameters);
  EXPECT_NEAR(start.y, 10e-6, 1e-18);
  EXPECT_NEAR(start.z, 100e-6, 1e-18);
  EXPECT_NEAR(start.velocity_y, 0.1 - 0.01, 1e-15);
  EXPECT_NEAR(start.velocity_z, 0.2, 1e-15);
  EXPECT_EQ(start.theta_z, 1e-4);
  EXPECT_EQ(start.tilt_rate_y, 0.3);
}

TEST(RotorSection, NamesANodeThatTheRotorDoesNotHave) {
  Node table = Node::table(
      {{"geometry", to_node(small_rotor())},
       {"unbalance", Node::array({Node::table({{"node", Node(16, {"case.toml", 8, 30})}, {"me", 1e-6}})})}});
  Faults faults;
  (void)rotor_section().read(table, faults);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(to_string(faults.begin()->where), "case.toml:8:30");
  EXPECT_SAYS(faults.begin()->message, "rotor.unbalance#1.node = 16: the rotor has nodes 1 to 3.");
}

TEST(RotorSection, RefusesAGeometryThatIsNeitherFileNorTable) {
  Faults faults;
  (void)rotor_section().read(Node::table({{"geometry", 5}}), faults);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_SAYS(faults.begin()->message, "rotor.geometry is an integer, not the name of a file or a table.");
}

}  // namespace
}  // namespace rotordrop
