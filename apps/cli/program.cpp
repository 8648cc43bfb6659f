#include "apps/cli/program.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/cli/commands.hpp"
#include "apps/cli/run_outputs.hpp"
#include "apps/job/raster_helpers.hpp"
#include "apps/process/last_resort.hpp"
#include "apps/process/memory_lacked.hpp"
#include "apps/report/report_sections.hpp"
#include "apps/usage/usage_pages.hpp"
#include "cluster/serve.hpp"
#include "gis/error.hpp"
#include "gis/file/leftovers.hpp"
#include "gis/format/grid_io.hpp"
#include "gis/secrets.hpp"

namespace coastmesh {

namespace {

std::string wholeUsage(const std::vector<Command>& commands) {
  using Json = nlohmann::ordered_json;
  Json usage{{"coastmesh", COASTMESH_VERSION}, {"formats", Json::array()}, {"commands", Json::array()}};
  for (const GridFormat& format : gridFormats()) {
    usage["formats"].push_back({{"name", format.name},
                                {"endings", format.endings},
                                {"description", format.description},
                                {"readable", format.readable},
                                {"writable", format.writable},
                                {"beside_grid", format.beside_grid}});
  }
  for (const Command& command : commands) usage["commands"].push_back(Json::parse(command.line.options().jsonUsage()));
  return usage.dump(2) + "\n";
}

// Shown if the program is called without arguments.
std::string welcome(const std::vector<Command>& commands) {
  using Json = nlohmann::ordered_json;
  std::string text =
      "coastmesh turns coastlines and lakes into triangle meshes for ocean and lake models.\n\n"
      "Mesh the polygons of any vector file that GDAL reads, and look at the result:\n"
      "  coastmesh mesh lake.geojson -o lake.gpkg -o lake.nc\n"
      "  coastmesh info lake.nc\n"
      "  coastmesh plot lake.nc -o lake.png --color angle\n\n"
      "Commands:\n";
  for (const Command& command : commands) {
    const Json usage = Json::parse(command.line.options().jsonUsage());
    const std::string name = usage["command"];
    text += "  " + name + std::string(11 - std::min<std::size_t>(10, name.size()), ' ') +
            usage["help"].get<std::string>() + "\n";
  }
  return text + "\ncoastmesh COMMAND --help shows the options of a command, with examples; man coastmesh has it all.\n";
}

// CLI11 reports an option that is given twice by its number of values.
std::string mistakeOf(const CLI::ParseError& error) {
  const std::string text = oneLine(error.what());
  const std::size_t counts = text.find(": At Most 1 required");
  return counts == std::string::npos ? text : text.substr(0, counts) + " is given more than once";
}

// Removes what killed runs left in the folders of the outputs.
void removeLeftoversBeside(const std::vector<OptionTable::NamedOutput>& outputs) {
  std::set<std::string> folders;
  for (const OptionTable::NamedOutput& output : outputs)
    folders.insert(std::filesystem::path(output.path).parent_path().string());
  for (const std::string& folder : folders) removeLeftovers(folder);
}

}  // namespace

void Run::warn(const std::string& text) {
  warnings.push_back(withoutSecrets(text));
  std::fprintf(stderr, "coastmesh: warning: %s\n", warnings.back().c_str());
}

int runProgram(int argc, char** argv, Interrupt& interrupt, Cluster* cluster) {
  CLI::App app("Turns coastlines and lakes into triangle meshes for ocean and lake models", "coastmesh");
  app.set_version_flag("--version", std::string("coastmesh ") + COASTMESH_VERSION);
  app.footer(
      "coastmesh COMMAND --help shows the options of a command, with examples. Start with:\n"
      "  coastmesh mesh lake.geojson -o lake.gpkg\n");
  // Commands inherit this when they are added: a word after the command is not taken for a second command.
  app.require_subcommand(0, 1);
  std::vector<Command> commands;
  app.add_flag_callback(
         "--json-usage", [&commands] { throw UsageText{wholeUsage(commands)}; }, "print all commands' usage as JSON")
      ->trigger_on_parse();
  app.add_option_function<std::string>(
         "--usage-as", [&commands](const std::string& asked) { throw UsageText{usageAs(asked, wholeUsage(commands))}; },
         "print usage for other programs: bash, zsh, fish (completion), man, man:COMMAND, markdown")
      ->type_name("FORM")
      ->trigger_on_parse();
  for (const auto declare :
       {declareMesh, declareCheck, declareInfo, declarePlot, declareConvert, declareCut, declareRemesh, declareMerge,
        declareRivers, declareClean, declarePartition, declareGather}) {
    commands.push_back(declare(app));
  }
  if (argc < 2) {
    std::fputs(welcome(commands).c_str(), stdout);
    std::fflush(stdout);
    throw OptionError("no command was given; start with one of those above");
  }
  const auto isNamed = [&](const Command& command) { return command.line.options().name() == argv[1]; };
  if (argc > 1 && argv[1][0] != '-' && std::ranges::none_of(commands, isNamed)) {
    throw OptionError("there is no command '" + std::string(argv[1]) + "'; coastmesh --help lists them");
  }
  std::vector<std::string> former_names;
  try {
    std::vector<std::string> arguments(argv + 1, argv + argc);
    const auto command = std::ranges::find_if(commands, isNamed);
    if (command != commands.end()) {
      arguments = command->line.toParse({arguments.begin() + 1, arguments.end()}, former_names);
      arguments.insert(arguments.begin(), argv[1]);
    }
    std::ranges::reverse(arguments);  // CLI11 expects them reversed
    app.parse(std::move(arguments));
  } catch (const CLI::Success& asked) {  // --help, --version
    std::ostringstream text, errors;
    app.exit(asked, text, errors);
    throw UsageText{text.str()};
  } catch (const CLI::ParseError& error) {
    throw OptionError(mistakeOf(error) + "; coastmesh COMMAND --help lists the options");
  }
  std::set<std::string> names;
  for (const Command& command : commands) names.insert(command.line.options().name());
  for (Command& command : commands) {
    if (!command.line.chosen()) continue;
    command.line.complete(names, former_names);
    requireOutputsApart(command.line.options());
    removeLeftoversBeside(command.line.options().outputs());
    Run run{interrupt, cluster, {}, {}, command.line.options()};
    for (const auto& [option, path] : command.line.options().inputs()) run.inputs.push_back(path);
    for (const std::string& sentence : former_names) run.warn(sentence);
    for (const std::string& sentence : command.line.options().withoutEffect()) run.warn(sentence);
    const int code = command.run(run);
    finishedWith(code);
    return code;
  }
  throw std::logic_error("a command was parsed that was never declared");
}

ServeOptions helpIn(const Interrupt& interrupt) {
  return {[&interrupt] { return interrupt.requested(); }, memoryLacked, peakMemoryMib, answerRasterTask};
}

}  // namespace coastmesh
