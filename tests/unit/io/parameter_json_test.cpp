#include "io/text/json_reader.h"

#include "base/errors.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace rotordrop;
using testing::AllOf;
using testing::HasSubstr;

namespace {

std::string error_of(const std::string& text) {
  try {
    parse_json(text, "rotor.json");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace

TEST(Json, KeepsTheOrderOfTheFileAndTheTypesOfValues) {
  const Node tree =
      parse_json(R"({"z": 1, "a": -2.5e3, "b": true, "n": null, "s": "x\"y", "l": [1, [2], {}], "t": {"y": []}})", "f");
  EXPECT_EQ(to_text(tree), "{z = 1, a = -2500, b = true, n = null, s = x\"y, l = [1, [2], {}], t = {y = []}}");
  EXPECT_TRUE(tree.find("z")->is(Node::Kind::integer));
  EXPECT_TRUE(tree.find("a")->is(Node::Kind::real));
}

TEST(Json, KnowsThePlaceOfKeysAndValues) {
  const Node tree = parse_json(
      "{\n"
      "  \"mass\": 85.5,\n"
      "  \"\\\"é\\\\\" : \"a,b:{\", \"x\":[ 1,\n"
      "   {\"y\": false}],\"z\":{}\n"
      "}\n",
      "rotor.json");
  EXPECT_EQ(to_string(tree.where()), "rotor.json:1:1");
  EXPECT_EQ(to_string(position_of(tree, "mass")), "rotor.json:2:3");
  EXPECT_EQ(to_string(position_of_value(tree, "mass")), "rotor.json:2:11");
  EXPECT_EQ(to_string(position_of_value(tree, "\"é\\")), "rotor.json:3:13");
  EXPECT_EQ(to_string(position_of(tree, "x")), "rotor.json:3:22");
  EXPECT_EQ(to_string(tree.find("x")->items()[0].where()), "rotor.json:3:28");
  EXPECT_EQ(to_string(position_of_value(tree.find("x")->items()[1], "y")), "rotor.json:4:10");
  EXPECT_EQ(to_string(position_of(tree, "z")), "rotor.json:4:18");
}

TEST(Json, AByteOrderMarkTakesNoColumn) {
  EXPECT_EQ(to_string(position_of(parse_json("\xEF\xBB\xBF{\"a\": 1}", "f"), "a")), "f:1:2");
}

TEST(Json, ASyntaxErrorIsReportedWithItsPlace) {
  EXPECT_THAT(error_of("{\n  \"a\": 1,\n  \"b\" 2\n}"),
              AllOf(HasSubstr("error: rotor.json:3:7: this is not valid JSON"), HasSubstr("expected ':'")));
  EXPECT_THAT(error_of("{\"a\": 1"), HasSubstr("error: rotor.json:1:8: this is not valid JSON"));
  EXPECT_THAT(error_of(""), HasSubstr("rotor.json:1:1: this is not valid JSON"));
  EXPECT_THAT(error_of("{} {}"), HasSubstr("rotor.json:1:4: "));
  EXPECT_THAT(error_of("{\"a\": 1e999}"), HasSubstr("this is not valid JSON: number overflow"));
}

TEST(Json, AKeyThatOccursTwiceIsAFault) {
  EXPECT_THAT(error_of("{\"a\": 1,\n\"a\": 2}"), HasSubstr("rotor.json:2:1: key \"a\" occurs twice"));
}

TEST(Json, AMissingFileIsNamed) { EXPECT_THROW(read_json("/nowhere/rotor.json"), InputError); }
