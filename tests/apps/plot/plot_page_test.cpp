#include "apps/plot/plot_page.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "gis/error.hpp"

namespace coastmesh::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

class PlotPage : public testing::Test {
 protected:
  PlotPage() {
    std::string name = (fs::temp_directory_path() / "coastmesh-page-XXXXXX").string();
    folder_ = mkdtemp(name.data());
  }
  ~PlotPage() override { fs::remove_all(folder_); }

  std::string pageOf(const Grid& grid, const PageOptions& options) {
    const std::string path = (folder_ / "a.html").string();
    plotPage(grid, options, path);
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  static Json factsOf(const std::string& page) {
    const std::string mark = "id=\"facts\">";
    const std::size_t from = page.find(mark) + mark.size();
    return Json::parse(page.substr(from, page.find("</script>", from) - from));
  }

  // Two triangles in a plane, and a node that belongs to neither.
  static Grid square() {
    Grid grid;
    grid.nodes = {{0, 0}, {4, 0}, {4, 2}, {0, 2}, {std::numeric_limits<double>::quiet_NaN(), 1e300}};
    grid.triangles = {{0, 1, 2}, {0, 2, 3}};
    return grid;
  }

  fs::path folder_;
};

TEST_F(PlotPage, RefusesWhatItCannotShow) {
  const auto refused = [this](const Grid& grid, const PageOptions& options) { pageOf(grid, options); };
  EXPECT_THROW(refused({}, {}), InputError);
  EXPECT_THROW(refused(square(), {.color = PlotColor::Depth}), InputError);
  EXPECT_THROW(refused(square(), {.color = PlotColor::Feature}), InputError);
  EXPECT_THROW(refused(square(), {.color = PlotColor::Piece}), OptionError);
  EXPECT_THROW(refused(square(), {.view = GlobeView{}}), InputError);
  EXPECT_THROW(refused(square(), {.view = GlobeView{.all = true}}), OptionError);
  EXPECT_FALSE(fs::exists(folder_ / "a.html"));
}

TEST_F(PlotPage, NothingInATitleEndsAnElement) {
  Grid grid = square();
  grid.title = "a </script><b> & \"c\" \xff";
  const std::string page = pageOf(grid, {});
  EXPECT_NE(page.find("<title>a &lt;/script>&lt;b> &amp; &quot;c&quot; \xef\xbf\xbd</title>"), std::string::npos);
  EXPECT_EQ(page.find("</script><b>"), std::string::npos);
  EXPECT_EQ(factsOf(page)["title"], "a </script><b> & \"c\" \xef\xbf\xbd");
}

TEST_F(PlotPage, SaysWhatItShows) {
  const Json facts = factsOf(pageOf(square(), {.name = "square", .edges = false, .min_angle_deg = 20}));
  EXPECT_EQ(facts["title"], "square");
  EXPECT_EQ(facts["triangles"], 2);
  EXPECT_EQ(facts["coordinates"], "plane");
  EXPECT_EQ(facts["edges"], false);
  EXPECT_EQ(facts["min_angle"], 20.0);
  EXPECT_EQ(facts["color"], "angle");
  EXPECT_EQ(facts["colors"], (Json{"none", "angle", "quality", "size", "region"}));
  EXPECT_EQ(facts["view"]["half"], (Json{1.0, 0.5}));
  EXPECT_EQ(facts["lines"], (Json{{{"kind", "shore"}, {"array", "line_0"}}}));
}

TEST_F(PlotPage, HalvesOfQuadrilateralsHaveTheGreatestAngleOfTheWhole) {
  const auto hasQuads = [this](const Grid& grid) {
    const Json arrays = factsOf(pageOf(grid, {}))["arrays"];
    return std::ranges::any_of(arrays, [](const Json& array) { return array["name"] == "greatest_of_quad"; });
  };
  Grid grid = square();
  EXPECT_FALSE(hasQuads(grid));
  grid.quad_of = {0, 0};
  EXPECT_TRUE(hasQuads(grid));
}

TEST_F(PlotPage, RiversWeirsAndLinesAreToldApart) {
  Grid grid = square();
  grid.boundaries = {{BoundaryRole::River, false, {0, 1}},
                     {BoundaryRole::Land, false, {1, 2}, 24, {3, 0}, false, {1, 1}},
                     {BoundaryRole::Land, false, {2, 3, 0}}};
  grid.lines = {{LineKind::Constraint, "", false, {0, 2}}};
  std::vector<std::string> kinds;
  const Json facts = factsOf(pageOf(grid, {}));
  for (const Json& line : facts["lines"]) kinds.push_back(line["kind"]);
  EXPECT_EQ(kinds, (std::vector<std::string>{"constraint", "weir", "land", "river"}));
}

}  // namespace
}  // namespace coastmesh::test
