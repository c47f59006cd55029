#include "core/config/declared_key.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/config/load.hpp"
#include "core/config/section.hpp"

namespace drift::declared_key_test {
namespace {

using namespace drift::config;
using config::Node;
using Kind = DeclaredKey::Kind;

const DeclaredKey& found(const Report& report, const std::string& section, const std::string& key) {
  const auto at = std::ranges::find_if(report.declared(), [&](const DeclaredKey& d) {
    return d.section == section && d.key == key;
  });
  if (at == report.declared().end()) throw std::out_of_range(section + "." + key);
  return *at;
}

/// Reads one key of each kind.
void read(Report& report, const Node& root) {
  enum class Way { caged, torqued };
  constexpr Named<Way> ways[] = {{"caged", Way::caged}, {"torqued", Way::torqued}};
  Section top(report, &root, Place{}, "");
  double number = 0.0, quantity = 0.0;
  std::uint64_t seed = 0;
  bool truth = false;
  std::string text;
  Vec3 three = Vec3::Zero();
  Way way = Way::caged;
  top.require("number", "number = 1");
  top.read(Option{"number", unit::one, 0.0, 5.0}, number);
  top.read(Option{"quantity", unit::minute, 1.0, 9.0}, quantity);
  top.read(Option{"seed", unit::one, 0.0, 0x1p64}, seed);
  top.read(Option{.key = "truth"}, truth);
  top.read(Option{.key = "text"}, text);
  top.read(Option{.key = "three"}, three);
  top.read(Option{.key = "way"}, way, ways);
  const Node* own = top.take("own");
  Section table(report, own, Place{}, "own");
  if (const Node* later = top.take("later"))
    read_quantity(report, *later, "later", Option{"later", unit::deg, -1.0, 1.0});
  for (Section& item : top.sections("item")) {
    item.read(Option{.key = "name"}, text);
    item.finish();
  }
  top.finish();
}

TEST(DeclaredKey, SaysWhatEveryKeyTakesPresentOrNot) {
  Report report("t", Declared::kept);
  read(report, parse_document("[[item]]\n", "t"));
  const DeclaredKey& number = found(report, "", "number");
  EXPECT_EQ(number.kind, Kind::number);
  EXPECT_TRUE(number.required);
  EXPECT_EQ(number.option.max, 5.0);
  const DeclaredKey& quantity = found(report, "", "quantity");
  EXPECT_EQ(quantity.kind, Kind::quantity);
  EXPECT_FALSE(quantity.required);
  EXPECT_EQ(quantity.option.unit.symbol.view(), "min");
  EXPECT_EQ(range_text(quantity.option), "1 min to 9 min");
  EXPECT_EQ(found(report, "", "seed").kind, Kind::whole);
  EXPECT_TRUE(unbounded_whole(found(report, "", "seed").option));
  EXPECT_EQ(found(report, "", "truth").kind, Kind::truth_value);
  EXPECT_EQ(found(report, "", "text").kind, Kind::text);
  EXPECT_EQ(found(report, "", "three").kind, Kind::vector);
  EXPECT_EQ(found(report, "", "way").choices, (std::vector<std::string>{"caged", "torqued"}));
  EXPECT_EQ(found(report, "", "own").kind, Kind::table) << "a section was made of it";
  EXPECT_EQ(found(report, "", "later").kind, Kind::unknown) << "said only where it is given";
  EXPECT_EQ(found(report, "", "item").kind, Kind::sections);
  EXPECT_EQ(found(report, "item.0", "name").kind, Kind::text);
}

TEST(DeclaredKey, OfWhatIsReadByHandIsDeclaredWhereItIsGiven) {
  Report report("t", Declared::kept);
  read(report, parse_document("later = \"?\"\n", "t"));
  const DeclaredKey& later = found(report, "", "later");
  EXPECT_EQ(later.kind, Kind::quantity);
  EXPECT_EQ(later.option.unit.symbol.view(), "deg");
  EXPECT_EQ(later.option.min, -1.0);
}

TEST(DeclaredKey, AReportThatIsNotAskedKeepsNothing) {
  Report report("t");
  read(report, parse_document("number = 1\n", "t"));
  EXPECT_TRUE(report.declared().empty());
}

}  // namespace
}  // namespace drift::declared_key_test
