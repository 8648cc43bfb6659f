#include "apps/usage/option_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "apps/usage/option_keywords.hpp"

namespace coastmesh {

namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class OptionTableTest : public testing::Test {
 protected:
  OptionTableTest() : table_("knit", "Knit a sock") {
    table_.number("--heel-angle", angle_, "DEG", {0.0, 45.0}, "angle");
    table_.integer("--count", count_, "N", 2, 9, "count");
    table_.flag("--coarsen,!--no-coarsen", coarsen_, "coarsen").formerly({"--felt", "--no-felt"});
    table_.choice("--toe", toe_, {"round", "star"}, "toe");
    table_.text("--path", path_, "FILE", "path").needs({"--toe star"});
    table_.numbers(
        "--box", "W,S,E,N", false,
        [this](const std::vector<double>& box) {
          box_ = box;
          return box.empty() || box[0] < box[2] ? std::string{} : "is turned";
        },
        "box");
  }

  std::string refusal(const std::string& name, const OptionValue& value) {
    try {
      table_.set(name, value, "it");
    } catch (const OptionError& error) {
      return error.what();
    }
    return {};
  }

  double angle_ = 33.0;
  std::uint64_t count_ = 4;
  bool coarsen_ = true;
  std::string toe_ = "round", path_;
  std::vector<double> box_;
  OptionTable table_;
};

TEST_F(OptionTableTest, TakesValuesOfTheirOwnTypes) {
  table_.set("--heel-angle", 0.1 + 0.2, "0.3");
  table_.set("--count", std::uint64_t{9}, "9");
  table_.set("--coarsen", false, "False");
  table_.set("--toe", std::string("star"), "star");
  table_.set("--box", std::vector<double>{1, 2, 3, 4}, "box");
  EXPECT_EQ(angle_, 0.30000000000000004);
  EXPECT_EQ(count_, 9u);
  EXPECT_FALSE(coarsen_);
  EXPECT_EQ(toe_, "star");
  EXPECT_THAT(box_, ElementsAre(1, 2, 3, 4));
}

TEST(OptionLabels, AreNotSaidTwice) {
  EXPECT_EQ(saidOf("Bounding box", "mesh only there"), "Bounding box: mesh only there");
  EXPECT_EQ(saidOf("Smallest angle", "smallest angle asked for", "*"), "*Smallest angle* asked for");
  EXPECT_EQ(saidOf("Size", "size"), "Size");
  EXPECT_EQ(saidOf("Size of all", "size"), "Size of all: size");
  EXPECT_EQ(saidOf("", "size"), "size");
}

TEST(OptionSections, OptionsAreShownByThemAndInThemAsDeclared) {
  OptionTable table("knit", "Knit a sock");
  bool value = false;
  table.flag("--loose", value, "");
  table.section(Section::Output);
  table.flag("--wrapped", value, "");
  table.section(Section::Sizes);
  table.flag("--wide", value, "");
  table.flag("--long", value, "");
  std::string wool;
  table.argument("WOOL", wool, "");
  std::vector<std::string> names;
  for (const OptionTable::Entry* entry : table.entries()) names.push_back(entry->name);
  EXPECT_THAT(names, ElementsAre("WOOL", "--wide", "--long", "--wrapped", "--loose"));
}

TEST_F(OptionTableTest, TextsAreReadAsValues) {
  table_.setText("--heel-angle", " +1.5e1");
  table_.setText("--count", "007");
  table_.setText("--box", "-1, 2,3 ,4e0");
  EXPECT_EQ(angle_, 15.0);
  EXPECT_EQ(count_, 7u);
  EXPECT_THAT(box_, ElementsAre(-1, 2, 3, 4));
  table_.set("--box", std::vector<double>{}, "[]");
  EXPECT_TRUE(box_.empty());
}

TEST_F(OptionTableTest, AnEmptyTextIsNoValue) {
  for (const char* option : {"--heel-angle", "--count", "--box", "--toe", "--path"})
    EXPECT_THROW(table_.setText(option, ""), OptionError) << option;
}

TEST_F(OptionTableTest, RefusesTypedValuesAsTexts) {
  EXPECT_EQ(refusal("--heel-angle", 45.5), "'it' is not a number in the range 0 to 45");
  EXPECT_EQ(refusal("--heel-angle", std::nan("")), "'it' is not a number in the range 0 to 45");
  EXPECT_THAT(refusal("--heel-angle", 1e-300), HasSubstr("nearer to 0 than 1e-70"));
  EXPECT_EQ(refusal("--count", std::uint64_t{1}), "'it' is not a whole number in the range 2 to 9");
  EXPECT_EQ(refusal("--count", std::string("2.5")), "'it' is not a whole number in the range 2 to 9");
  EXPECT_EQ(refusal("--toe", std::string("square")), "'it' is none of round, star");
  EXPECT_THAT(refusal("--box", std::vector<double>{1, 2, 3}), HasSubstr("W,S,E,N"));
  EXPECT_THAT(refusal("--box", std::vector<double>{1, 2, std::nan(""), 4}), HasSubstr("W,S,E,N"));
  EXPECT_EQ(refusal("--box", std::vector<double>{3, 2, 1, 4}), "'it' is turned");
  EXPECT_EQ(angle_, 33.0);
  EXPECT_EQ(count_, 4u);
  for (const char* text : {"1,2,3", "1,2,3,4,", "1,2,3,4,5", "1,2,x,4", "1,2,3,1e999", "1,,3,4"})
    EXPECT_THROW(table_.setText("--box", text), OptionError) << text;
  for (const char* text : {"", "3x", "0x3", "nan", "inf", "1 2"})
    EXPECT_THROW(table_.setText("--heel-angle", text), OptionError) << text;
}

TEST_F(OptionTableTest, WhatHasNoEffectIsKnownOfTypedValuesToo) {
  table_.set("--path", std::string("a"), "a");
  EXPECT_THAT(table_.withoutEffect(), ElementsAre("--path has no effect without --toe star"));
  table_.set("--toe", std::string("star"), "star");
  EXPECT_TRUE(table_.withoutEffect().empty());
}

TEST_F(OptionTableTest, FilesGivenAreInputs) {
  table_.set("--path", std::string("a.shp"), "a.shp");
  ASSERT_EQ(table_.inputs().size(), 1u);
  EXPECT_EQ(table_.inputs()[0].option, "--path");
  EXPECT_EQ(table_.inputs()[0].path, "a.shp");
}

TEST_F(OptionTableTest, KeywordsNameOptions) {
  EXPECT_EQ(optionOf("heel_angle", table_)->entry->name, "--heel-angle");
  EXPECT_FALSE(optionOf("heel_angle", table_)->former);
  EXPECT_EQ(optionOf("felt", table_)->entry->name, "--coarsen");
  EXPECT_TRUE(optionOf("felt", table_)->former);
  EXPECT_FALSE(optionOf("heel-angle", table_));
  EXPECT_FALSE(optionOf("no_coarsen", table_));
}

TEST_F(OptionTableTest, MessagesNameKeywordsButFilesAsTheyAre) {
  EXPECT_EQ(inKeywords("--path has no effect without --toe star", table_), "path has no effect without toe='star'");
  EXPECT_EQ(inKeywords("give --heel-angle, or --no-coarsen.", table_), "give heel_angle, or coarsen=False.");
  EXPECT_EQ(inKeywords("--toe starry --toes", table_), "toe starry --toes");
  for (const char* same : {"'--path.shp'", "a--path", "--path/b", "x/--path", "-- path --", "--unknown"})
    EXPECT_EQ(inKeywords(same, table_), same);
}

}  // namespace

}  // namespace coastmesh
