// Outputs never replace an input, another output of the same run, or something that is not a regular file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <map>

#include "tests/cli/program.hpp"

namespace coastmesh::test {

namespace {

using ::testing::HasSubstr;

class Outputs : public ProgramTest {
 protected:
  // Expects a refusal before anything is read or written, despite --overwrite.
  void expectRefused(std::vector<std::string> arguments, const std::string& named) {
    const std::set<std::string> before = names();
    std::map<std::string, std::string> texts;
    for (const std::string& name : before)
      texts[name] = std::filesystem::is_regular_file(file(name)) ? readText(file(name)) : "";
    arguments.push_back("--overwrite");
    const ProgramRun run = runProgram(arguments);
    EXPECT_EQ(run.code, 2) << testing::PrintToString(arguments) << run.errors << run.output;
    EXPECT_TRUE(isOneErrorLine(run.errors));
    EXPECT_THAT(run.errors, HasSubstr(named));
    EXPECT_EQ(names(), before);
    for (const auto& [name, text] : texts)
      if (!text.empty()) {
        EXPECT_EQ(readText(file(name)), text) << name;
      }
  }
};

TEST_F(Outputs, NeverReplaceAFileThatAnyOptionReads) {
  const std::string input = lake();
  const std::string other = write("other.nc", "what it holds does not matter");
  for (const std::string option : {"--bathymetry", "--size-raster", "--size-features", "--regions", "--boundaries",
                                   "--constraints", "--weirs", "--clip", "--passages", "--barriers"}) {
    expectRefused({"mesh", input, option, other, "-o", other}, option);
    expectRefused({"mesh", input, option + "=" + other, "-o", file("./other.nc")}, option);
  }
  const std::string config = write("job.json", "{\"size-max\": 900}");
  expectRefused({"mesh", input, "--config", config, "-o", file("out.nc"), "--report", config}, "--config");
  expectRefused({"mesh", input, "-o", file("out.nc"), "--report", input}, "INPUT");
  expectRefused({"clean", input, "-o", file("out.gpkg"), "--report", input}, "INPUT");
  expectRefused({"check", other, "--input", input, "-o", input}, "--input");
  expectRefused({"plot", other, "-o", other}, "MESH");
  expectRefused({"convert", other, "--bathymetry", input, "-o", file("x.2dm"), "-o", input}, "--bathymetry");
}

// Known before the mesh is made: formats of models cannot say that a node has no depth.
TEST_F(Outputs, ThatUnknownDepthsPreventAreWarnedOf) {
  const auto rasterFrom = [this](double west) {
    return write("depths.asc", "ncols 2\nnrows 2\nxllcorner " + std::to_string(west) +
                                   "\nyllcorner 41.5\ncellsize 0.1\n-9 -9\n-9 -9\n");
  };
  const auto runWith = [&](double west, const char* const fill, const char* const output) {
    return runProgram({"mesh", lake(), "--bathymetry", rasterFrom(west), "--depth-fill", fill, "-o", file(output),
                       "--overwrite", "--size", "300"});
  };
  const auto warning = HasSubstr("coastmesh: warning: --depth-fill none: '" + file("a.14") + "' cannot say that");
  const ProgramRun covered = runWith(-87.6, "none", "a.14"), bare = runWith(-87.49, "none", "a.14");
  EXPECT_EQ(covered.code, 0) << covered.errors;
  EXPECT_THAT(covered.errors, warning);
  EXPECT_EQ(bare.code, 4);
  EXPECT_THAT(bare.errors, warning);
  EXPECT_THAT(runWith(-87.6, "none", "a.2dm").errors, HasSubstr("--depth-fill none: '" + file("a.2dm") + "' cannot"));
  for (const ProgramRun& run : {runWith(-87.49, "nearest", "a.14"), runWith(-87.49, "none", "a.nc")}) {
    EXPECT_EQ(run.code, 0) << run.errors;
    EXPECT_THAT(run.errors, ::testing::Not(HasSubstr("--depth-fill none:")));
  }
}

// No temporary file remains, however low the limit of open files is.
TEST_F(Outputs, LeaveNothingWhereDescriptorsLack) {
  const std::string input = lake();
  for (const char* const ending : {".gpkg", ".nc", ".14", ".shp", ".geojson", ".vtu"}) {
    for (int most = 4; most <= 10; ++most) {
      const std::string limit = "ulimit -n " + std::to_string(most) + "; exec \"$0\" ";
      const ProgramRun run =
          runShell(limit + "mesh '" + input + "' -o '" + file("a" + std::string(ending)) + "' --quiet --overwrite");
      for (const std::string& name : names())
        EXPECT_FALSE(name.starts_with('.')) << name << " of " << ending << " with " << most;
      if (run.code != 0) {
        EXPECT_NE(run.errors, "") << ending << " with " << most;
      }
    }
  }
}

TEST_F(Outputs, NeverReplaceAnInputThroughLinks) {
  const std::string input = lake();
  std::filesystem::create_symlink(input, file("link.geojson"));
  std::filesystem::create_hard_link(input, file("hard.geojson"));
  std::filesystem::create_directory_symlink(file("."), file("folder"));
  expectRefused({"mesh", input, "-o", file("link.geojson")}, "INPUT");
  expectRefused({"mesh", file("link.geojson"), "-o", input}, "INPUT");
  expectRefused({"mesh", input, "-o", file("hard.geojson")}, "INPUT");
  expectRefused({"mesh", input, "-o", file("folder/lake.geojson")}, "INPUT");
}

TEST_F(Outputs, NeverReplaceWhatBelongsToAnInput) {
  write("a.poly", "4 2 0 0\n1 0 0\n2 1 0\n3 1 1\n4 0 1\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n0\n");
  expectRefused({"mesh", file("a.poly"), "-o", file("a.ele")}, "a.poly");
  std::filesystem::copy_file(lake(), file("x_nodes.geojson"));
  expectRefused({"mesh", file("x_nodes.geojson"), "-o", file("x.geojson")}, "x_nodes.geojson");
  write("sea.shp", "a shapefile's");
  write("sea.dbf", "attributes");
  expectRefused({"mesh", file("sea.shp"), "-o", file("out.nc"), "--report", file("sea.dbf")}, "sea.shp");
}

// A virtual data set has no data of its own: the files that it names are inputs too.
TEST_F(Outputs, NeverReplaceWhatAVirtualInputTakesItsDataFrom) {
  std::filesystem::copy_file(lake(), file("inner.geojson"));
  const std::string layers =
      write("layers.vrt",
            "<OGRVRTDataSource><OGRVRTLayer name=\"inner\"><SrcDataSource relativeToVRT=\"1\">inner.geojson"
            "</SrcDataSource></OGRVRTLayer></OGRVRTDataSource>");
  expectRefused({"mesh", layers, "-o", file("inner.geojson")}, "INPUT reads it");
  expectRefused({"mesh", lake(), "--constraints", layers, "-o", file("m.nc"), "--report", file("inner.geojson")},
                "--constraints");
  const auto raster = [&](const std::string& name, const std::string& source) {
    return write(name,
                 "<VRTDataset rasterXSize=\"2\" rasterYSize=\"2\"><GeoTransform>-88, 1, 0, 42, 0, -1</GeoTransform>"
                 "<VRTRasterBand dataType=\"Float32\" band=\"1\"><SimpleSource><SourceFilename relativeToVRT=\"1\">" +
                     source +
                     "</SourceFilename><SourceBand>1</SourceBand></SimpleSource></VRTRasterBand></VRTDataset>");
  };
  write("depths.asc", "ncols 2\nnrows 2\nxllcorner -88\nyllcorner 40\ncellsize 1\n5 6\n7 8\n");
  const std::string inner = raster("inner.vrt", "depths.asc"), outer = raster("outer.vrt", "inner.vrt");
  for (const std::string option : {"--bathymetry", "--size-raster"}) {
    expectRefused({"mesh", lake(), option, outer, "-o", file("m.nc"), "--report", file("depths.asc")}, option);
    expectRefused({"mesh", lake(), option, outer, "-o", file("m.nc"), "--report", inner}, option);
    expectRefused({"mesh", lake(), option, "vrt://" + inner, "-o", file("m.nc"), "--report", file("depths.asc")},
                  option);
  }
  // These inputs are readable, and other files beside them may be replaced.
  const ProgramRun run =
      runProgram({"mesh", layers, "--bathymetry", outer, "-o", file("other.geojson"), "--overwrite"});
  EXPECT_EQ(run.code, 0) << run.errors;
}

// Outputs of an earlier run beside an input may be replaced, so that a run can be repeated.
TEST_F(Outputs, OfAnEarlierRunAreReplaced) {
  const std::vector<std::string> arguments{"mesh", lake(),           "-o",         file("lake.shp"),
                                           "-o",   file("lake.2dm"), "-o",         file("lake.node"),
                                           "-o",   file("lake.nc"),  "--overwrite"};
  const ProgramRun first = runProgram(arguments);
  ASSERT_EQ(first.code, 0) << first.errors;
  const std::set<std::string> before = names();
  const ProgramRun second = runProgram(arguments);
  EXPECT_EQ(second.code, 0) << second.errors;
  EXPECT_EQ(names(), before);
}

TEST_F(Outputs, ThatShareAFileAreRefused) {
  const std::string input = lake();
  const auto pair = [&](const std::string& a, const std::string& b, const std::string& option = "-o") {
    expectRefused({"mesh", input, "-o", file(a), option, file(b)}, b);
  };
  pair("o.gr3", "o.ll");
  pair("o.node", "o.ele");
  pair("o.node", "o.poly", "--report");
  pair("o.nc", "o.nc", "--report");
  pair("o.nc", "./o.nc");
  pair("o.slf", "o.cli", "--report");
  pair("o_grd.dat", "o_obc.dat", "--report");
  pair("o.shp", "o.dbf", "--report");
  pair("o.shp", "o.prj", "--report");
  pair("o.geojson", "o_nodes.geojson");
  pair("o.gpkg", "o.gpkg-wal", "--report");
  expectRefused({"clean", input, "-o", file("o.gpkg"), "--report", file("o.gpkg")}, "o.gpkg");
  std::filesystem::create_directory_symlink(file("."), file("folder"));
  expectRefused({"mesh", input, "-o", file("o.nc"), "--report", file("folder/o.nc")}, "folder/o.nc");
}

// Formats that store their CRS in a .prj may share it.
TEST_F(Outputs, ThatShareAPrjAreWritten) {
  const ProgramRun run =
      runProgram({"mesh", lake(), "-o", file("o.2dm"), "-o", file("o.msh"), "-o", file("o.14"), "-o", file("o.shp")});
  EXPECT_EQ(run.code, 0) << run.errors;
  EXPECT_EQ(names().count("o.prj"), 1u);
}

TEST_F(Outputs, WhatIsNoRegularFileIsNotReplaced) {
  const std::string input = lake();
  ASSERT_EQ(mkfifo(file("pipe.nc").c_str(), 0600), 0);
  const std::string kept = write("kept.nc", "precious");
  std::filesystem::create_symlink(kept, file("link.nc"));
  std::filesystem::create_symlink(file("nowhere.nc"), file("dangling.nc"));
  const std::set<std::string> before = names();
  for (const std::string name : {"pipe.nc", "link.nc", "dangling.nc"}) {
    for (const std::string option : {"-o", "--report"}) {
      std::vector<std::string> arguments{"mesh", input, option, file(name), "--overwrite"};
      if (option == "--report") arguments.insert(arguments.end(), {"-o", file("out.nc")});
      const ProgramRun run = runProgram(arguments);
      EXPECT_EQ(run.code, 4) << name << run.errors;
      EXPECT_TRUE(isOneErrorLine(run.errors));
      EXPECT_THAT(run.errors, HasSubstr(name));
      EXPECT_EQ(names(), before);
    }
  }
  EXPECT_EQ(readText(kept), "precious");
  EXPECT_TRUE(std::filesystem::is_fifo(file("pipe.nc")));
  EXPECT_TRUE(std::filesystem::is_symlink(file("link.nc")));
}

TEST_F(Outputs, ADashIsNoFile) {
  expectRefused({"mesh", lake(), "-o", "-", "--format", "ugrid"}, "standard output");
  const ProgramRun run = runProgram({"mesh", lake(), "-o", file("o.nc"), "--report", "-"});
  EXPECT_EQ(run.code, 0) << run.errors;
  EXPECT_TRUE(run.output.starts_with("{")) << run.output;
  EXPECT_TRUE(run.output.ends_with("}\n")) << run.output;
  expectRefused({"mesh", lake(), "-o", file("p.nc"), "--report", "-", "--progress", "json"}, "--progress json");
}

TEST_F(Outputs, AFileSizeLimitLeavesNothing) {
  const std::string input = lake();
  for (const std::string output :
       {"o.nc", "o.gpkg", "o.2dm", "o.shp", "o.slf", "o.14", "o.msh", "o.vtu", "o.node", "o.geojson"}) {
    const std::set<std::string> before = names();
    const ProgramRun run =
        runShell("ulimit -f 1; \"$0\" mesh '" + input + "' -o '" + file(output) + "' --size-max 150 --quiet");
    EXPECT_EQ(run.code, 4) << output << run.errors;
    EXPECT_THAT(run.errors, HasSubstr("cannot write")) << output;
    EXPECT_EQ(names(), before) << output;
  }
  ASSERT_EQ(runProgram({"mesh", input, "-o", file("m.nc")}).code, 0);
  const std::set<std::string> before = names();
  for (const std::string picture : {"m.png", "m.svg", "m.html"}) {
    const ProgramRun run = runShell("ulimit -f 1; \"$0\" plot '" + file("m.nc") + "' -o '" + file(picture) + "'");
    EXPECT_EQ(run.code, 4) << picture;
    EXPECT_THAT(run.errors, HasSubstr(std::strerror(EFBIG))) << picture;
  }
  for (const std::string defects : {"d.gpkg", "d.geojson", "d.fgb"}) {
    const ProgramRun run =
        runShell("ulimit -f 1; \"$0\" check '" + file("m.nc") + "' --min-angle 55 -o '" + file(defects) + "'");
    EXPECT_EQ(run.code, 4) << defects;
    EXPECT_THAT(run.errors, HasSubstr(std::strerror(EFBIG))) << defects;
  }
  EXPECT_EQ(runShell("ulimit -f 1; \"$0\" clean '" + input + "' -o '" + file("c.gpkg") + "'").code, 4);
  EXPECT_EQ(names(), before);
}

// A disk of its own for each run, where the system lets users mount one.
TEST_F(Outputs, AFullDiskIsNamedAndLeavesNothing) {
  const std::string disk = file("disk"), input = lake();
  std::filesystem::create_directory(disk);
  const auto onDisk = [&](int kilobytes, const std::string& command) {
    return runShell("unshare --map-root-user --mount sh -c 'mount -t tmpfs -o size=" + std::to_string(kilobytes) +
                    "k none " + disk + " && { " + command + "; code=$?; ls -A " + disk + "; exit $code; }' \"$0\"");
  };
  if (onDisk(64, "true").code != 0) GTEST_SKIP() << "no disk can be mounted";
  ASSERT_EQ(runProgram({"mesh", input, "-o", file("m.nc"), "--size-max", "50"}).code, 0);
  for (const int kilobytes : {4, 32, 100}) {
    for (const std::string ending : {"gpkg", "fgb", "shp", "geojson", "nc"}) {
      const std::string output = disk + "/o." + ending;
      const ProgramRun run = onDisk(kilobytes, "\"$0\" convert " + file("m.nc") + " -o " + output);
      EXPECT_EQ(run.code, 4) << ending << kilobytes;
      EXPECT_EQ(run.output, "") << ending << kilobytes;
      EXPECT_THAT(run.errors, HasSubstr(std::strerror(ENOSPC))) << ending << kilobytes;
    }
  }
  for (const std::string defects : {"d.fgb", "d.geojson"}) {
    const ProgramRun run =
        onDisk(4, "\"$0\" check " + file("m.nc") + " --min-angle 55 -o " + disk + "/" + defects + " >&2");
    EXPECT_EQ(run.code, 4) << defects;
    EXPECT_EQ(run.output, "") << defects;
    EXPECT_THAT(run.errors, HasSubstr(std::strerror(ENOSPC))) << defects;
  }
}

TEST_F(Outputs, ErrorsOnStandardOutputAreSeen) {
  if (!std::filesystem::is_character_file("/dev/full")) GTEST_SKIP() << "no /dev/full";
  const std::string input = lake();
  ASSERT_EQ(runProgram({"mesh", input, "-o", file("m.nc")}).code, 0);
  const std::string mesh = "'" + file("m.nc") + "'";
  for (const std::string& words :
       {"info " + mesh, "check " + mesh, std::string("--help"), std::string("mesh --help"), std::string("--version"),
        std::string("--json-usage"), "mesh '" + input + "' -o '" + file("n.nc") + "' --progress json"}) {
    for (const std::string to : {"> /dev/full", ">&-"}) {
      const ProgramRun run = runShell("\"$0\" " + words + to);
      EXPECT_EQ(run.code, 4) << words << to << run.errors;
      EXPECT_TRUE(isOneErrorLine(run.errors));
      EXPECT_THAT(run.errors, HasSubstr("standard output"));
    }
  }
}

TEST_F(Outputs, PipesAreRead) {
  const std::string input = lake();
  const ProgramRun named = runShell("cat '" + input + "' | \"$0\" mesh /dev/stdin -o '" + file("a.2dm") + "'");
  EXPECT_EQ(named.code, 0) << named.errors;
  ASSERT_EQ(mkfifo(file("pipe").c_str(), 0600), 0);
  const ProgramRun pipe = runShell("cat '" + input + "' > '" + file("pipe") + "' & \"$0\" mesh '" + file("pipe") +
                                   "' -o '" + file("b.2dm") + "'");
  EXPECT_EQ(pipe.code, 0) << pipe.errors;
  EXPECT_EQ(readText(file("a.2dm")), readText(file("b.2dm")));
}

// A read error is not taken for the end of the input or for an empty input.
TEST_F(Outputs, StandardInputThatCannotBeReadIsRefused) {
  for (const std::string& words : {"mesh - -o '" + file("a.2dm") + "'", std::string("info /dev/stdin")}) {
    const ProgramRun run = runShell("\"$0\" " + words + " < '" + file(".") + "'");
    EXPECT_EQ(run.code, 3) << run.errors;
    EXPECT_TRUE(isOneErrorLine(run.errors)) << run.errors;
    EXPECT_THAT(run.errors, HasSubstr("'standard input': cannot be read: Is a directory"));
  }
}

TEST_F(Outputs, NestingInAFileOfOptionsIsRefused) {
  const auto repeated = [](const std::string& text) {
    std::string all;
    for (int i = 0; i < 30'000; ++i) all += text;
    return all;
  };
  const std::vector<std::string> files{write("a.json", repeated("{\"mesh\":") + "1" + repeated("}")),
                                       write("b.json", "{\"input\":" + repeated("[") + repeated("]") + "}"),
                                       write("c.toml", "input = " + repeated("[") + repeated("]")),
                                       write("d.toml", repeated("a.") + "b = 1\n"),
                                       write("e.toml", "[" + repeated("a.") + "b]\nc = = 1\n")};
  for (const std::string& config : files) {
    const ProgramRun run = runProgram({"mesh", "--config", config});
    EXPECT_EQ(run.code, 2) << config << run.errors;
    EXPECT_TRUE(isOneErrorLine(run.errors));
  }
}

TEST_F(Outputs, WhatAFileOfOptionsCallsInputIsNoOption) {
  const std::string input = lake();
  const std::string config = write(
      "job.toml", "input = ['" + input + "', '--output=" + file("x.nc") + "']\noutput = '" + file("y.nc") + "'\n");
  const ProgramRun run = runProgram({"mesh", "--config", config});
  EXPECT_EQ(run.code, 3) << run.errors;
  EXPECT_THAT(run.errors, HasSubstr("--output="));
  EXPECT_EQ(names(), (std::set<std::string>{"job.toml", "lake.geojson"}));
}

TEST_F(Outputs, OptionsWithoutEffectAreWarnedOf) {
  const ProgramRun run = runProgram(
      {"mesh", lake(), "-o", file("o.nc"), "--courant", "0.5", "--min-depth", "3", "--report", file("r.json")});
  EXPECT_EQ(run.code, 0) << run.errors;
  EXPECT_THAT(run.errors, HasSubstr("coastmesh: warning: --courant has no effect without --time-step\n"));
  EXPECT_THAT(run.errors, HasSubstr("coastmesh: warning: --min-depth has no effect without --bathymetry\n"));
  EXPECT_THAT(readText(file("r.json")), HasSubstr("\"--courant has no effect without --time-step\""));
  EXPECT_EQ(runProgram({"mesh", lake(), "-o", file("p.nc"), "--domain", "outside"}).code, 2);
  const ProgramRun kept = runProgram({"mesh", lake(), "-o", file("k.nc"), "--coast", "keep", "--channel-min", "2",
                                      "--land-min", "0", "--keep-water", "all"});
  EXPECT_EQ(kept.code, 0) << kept.errors;
  for (const char* option : {"--channel-min", "--land-min", "--keep-water"})
    EXPECT_THAT(kept.errors, HasSubstr(std::string(option) + " has no effect without --coast follow\n"));
  // Algorithms for comparison do not coarsen by default, and then nothing is optimised.
  const auto errorsOfQuality = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words{"mesh", lake(),      "-o",    file("q.nc"), "--size",
                                   "300",  "--quality", "links", "--overwrite"};
    words.insert(words.end(), more.begin(), more.end());
    return runProgram(words).errors;
  };
  EXPECT_THAT(errorsOfQuality({"--algorithm", "offcenter"}),
              HasSubstr("--quality has no effect without --coarsen or --smooth if --algorithm is not relocate\n"));
  EXPECT_EQ(errorsOfQuality({"--algorithm", "offcenter", "--coarsen"}), "");
  EXPECT_EQ(errorsOfQuality({}), "");
}

}  // namespace

}  // namespace coastmesh::test
