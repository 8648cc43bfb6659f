#include "apps/usage/usage_pages.hpp"

#include <algorithm>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string_view>

#include "apps/usage/option_table.hpp"
#include "gis/error.hpp"

namespace coastmesh {

namespace {

using Json = nlohmann::ordered_json;

std::string numberText(const Json& value) {
  std::string text = value.dump();
  if (text.ends_with(".0")) text.resize(text.size() - 2);
  return text;
}

std::string glued(std::initializer_list<std::string_view> parts) {
  std::string text;
  for (std::string_view part : parts) text += part;
  return text;
}

// The texts of a list, with `between` them.
std::string joined(const Json& list, std::string_view between) {
  std::string text;
  for (const Json& item : list) {
    if (!text.empty()) text += between;
    text += item.get<std::string>();
  }
  return text;
}

std::string valueOf(const Json& option) {
  if (option["type"] == "flag") return {};
  if (option["type"] != "choice") return option.value("unit", "VALUE");
  return joined(option["choices"], "|");
}

std::string defaultOf(const Json& option) {
  if (!option.contains("default") || option["default"].is_null()) return {};
  const Json& value = option["default"];
  if (value.is_boolean()) return value.get<bool>() ? "on" : "off";
  return value.is_string() ? value.get<std::string>() : numberText(value);
}

std::string rangeOf(const Json& option) {
  const bool open = option.contains("exclusive_minimum");
  const bool low = open || option.contains("minimum");
  const bool high = option.contains("maximum");
  if (open) {
    const std::string text = "above " + numberText(option["exclusive_minimum"]);
    return high ? text + ", up to " + numberText(option["maximum"]) : text;
  }
  if (low && high) return numberText(option["minimum"]) + " to " + numberText(option["maximum"]);
  if (low) return numberText(option["minimum"]) + " or more";
  return high ? numberText(option["maximum"]) + " or less" : std::string{};
}

// True if `option` begins a section; `section` is that of the option before, and becomes that of this one.
bool beginsSection(const Json& option, std::string& section) {
  if (option["section"] == section) return false;
  section = option["section"];
  return true;
}

// "0 to 45; default 33".
std::string factsOf(const Json& option) {
  std::string text = rangeOf(option);
  const std::string value = defaultOf(option);
  if (!value.empty()) text += (text.empty() ? "default " : "; default ") + value;
  if (option.value("required", false)) text += text.empty() ? "required" : "; required";
  const bool is_said = option["help"].get<std::string>().find("can be repeated") != std::string::npos;
  if (option.value("multiple", false) && !is_said) text += text.empty() ? "may be repeated" : "; may be repeated";
  return text;
}

const Json& commandNamed(const Json& usage, const std::string& name) {
  for (const Json& command : usage["commands"]) {
    if (command["command"] == name) return command;
  }
  throw OptionError("there is no command '" + name + "'");
}

// Manual pages ----------------------------------------------------------------------------------------------------

std::string roff(const std::string& text) {
  std::string out;
  for (char c : text) {
    if (c == '\\') {
      out += "\\e";
    } else if (c == '-') {
      out += "\\-";
    } else if (c == '\'' && (out.empty() || out.back() == '\n')) {
      out += "\\(aq";
    } else if (c == '.' && (out.empty() || out.back() == '\n')) {
      out += "\\&.";
    } else {
      out += c;
    }
  }
  return out;
}

std::string heading(const std::string& name, const Json& usage) {
  std::string title = name;
  std::ranges::transform(title, title.begin(), [](char c) { return c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c; });
  return glued(
      {".TH ", title, R"( 1 "" "coastmesh )", usage["coastmesh"].get<std::string>(), R"(" "User Commands")", "\n"});
}

std::string manExamples(const Json& command) {
  if (!command.contains("examples")) return {};
  std::string page = ".SH EXAMPLES\n";
  for (const Json& example : command["examples"]) {
    page += ".TP\n" + roff(example["help"]) + "\n.EX\n" + roff(example["command"]) + "\n.EE\n";
  }
  return page;
}

std::string manOf(const Json& usage, const Json& command) {
  const std::string verb = command["command"];
  std::string page = heading("coastmesh-" + verb, usage);
  page += ".SH NAME\ncoastmesh\\-" + verb + " \\- " + roff(command["help"]) + "\n.SH SYNOPSIS\n.B coastmesh " + verb +
          "\n[\\fIoptions\\fR]";
  for (const Json& argument : command["arguments"]) {
    page += " \\fI" + argument["name"].get<std::string>() + "\\fR" + (argument["multiple"] ? "..." : "");
  }
  page += "\n.SH ARGUMENTS\n";
  for (const Json& argument : command["arguments"]) {
    page += ".TP\n.I " + argument["name"].get<std::string>() + "\n" + roff(argument["help"]) + "\n";
  }
  page += ".SH OPTIONS\n";
  std::string section;
  for (const Json& option : command["options"]) {
    if (beginsSection(option, section)) page += ".SS " + roff(section) + "\n";
    std::string names;
    for (const Json& name : option["names"]) names += (names.empty() ? "\\fB" : ", \\fB") + roff(name) + "\\fR";
    const std::string value = valueOf(option);
    page += ".TP\n" + names + (value.empty() ? "" : " \\fI" + roff(value) + "\\fR") + "\n" +
            roff(saidOf(option["label"], option["help"]));
    const std::string facts = factsOf(option);
    page += facts.empty() ? "\n" : " (" + roff(facts) + ")\n";
  }
  page += manExamples(command);
  return page + ".SH SEE ALSO\n.BR coastmesh (1)\n";
}

std::string manOfAll(const Json& usage) {
  std::string page = heading("coastmesh", usage);
  page +=
      ".SH NAME\ncoastmesh \\- triangle meshes from coastlines and lakes, for ocean and lake models\n.SH SYNOPSIS\n"
      ".B coastmesh\n.I command\n[\\fIoptions\\fR] \\fIFILE\\fR...\n.SH COMMANDS\n";
  for (const Json& command : usage["commands"]) {
    page += ".TP\n.BR coastmesh\\-" + command["command"].get<std::string>() + " (1)\n" + roff(command["help"]) + "\n";
  }
  page += ".SH FORMATS\n";
  for (const Json& format : usage["formats"]) {
    std::string endings;
    for (const Json& ending : format["endings"]) endings += " " + ending.get<std::string>();
    const char* way = format["readable"] && format["writable"] ? ""
                      : format["writable"]                     ? " (written only)"
                                                               : " (read only)";
    page += ".TP\n.B " + roff(format["name"].get<std::string>()) + roff(endings) + "\n" +
            roff(format["description"].get<std::string>() + way) + "\n";
  }
  page +=
      ".SH EXIT STATUS\n.TP\n.B 0\ndone\n.TP\n.B 1\ndone, but the result misses a requirement\n.TP\n.B 2\nwrong "
      "usage\n.TP\n.B 3\ninput unreadable or unusable, or not enough memory\n.TP\n.B 4\noutput could not be "
      "written\n.TP\n.B 5\ninterrupted; no partial file is left\n.TP\n.B 70\na bug in coastmesh\n";
  for (const char* verb : {"mesh"}) page += manExamples(commandNamed(usage, verb));
  return page;
}

// Markdown --------------------------------------------------------------------------------------------------------

// For a cell of a table.
std::string cell(std::string text) {
  for (std::size_t at = text.find('|'); at != std::string::npos; at = text.find('|', at + 2)) text.insert(at, "\\");
  return text;
}

std::string formerly(const Json& option) {
  if (!option.contains("former_names")) return {};
  std::string names;
  for (const auto& [former, present] : option["former_names"].items())
    names += (names.empty() ? "`" : ", `") + former + "`";
  return "; formerly " + names + ", deprecated: works in this version with a warning, not in the next";
}

std::string markdown(const Json& usage) {
  std::string page =
      "# Every command and option\nMade from the program's own table by `coastmesh --usage-as markdown`; do not edit. "
      "Names in italics are the labels in dialogs.\n\nUnits: M metres on the ground, M2 square metres, DEG degrees. In "
      "a plane without a CRS, lengths are in its units.\n";
  for (const Json& command : usage["commands"]) {
    page += "\n## coastmesh " + command["command"].get<std::string>();
    for (const Json& argument : command["arguments"]) {
      page += " " + argument["name"].get<std::string>() + (argument["multiple"] ? "…" : "");
    }
    page += "\n" + command["help"].get<std::string>() + ".\n";
    std::string section;
    for (const Json& option : command["options"]) {
      if (beginsSection(option, section))
        page += "\n### " + section + "\n| option | unit or values | range | default | |\n|---|---|---|---|---|\n";
      const std::string required = option.value("required", false) ? "required" : defaultOf(option);
      page += "| " + cell("`" + joined(option["names"], "`, `") + "`") + " | " + cell(valueOf(option)) + " | " +
              cell(rangeOf(option)) + " | " + cell(required) + " | " +
              cell(saidOf(option["label"], option["help"], "*")) + formerly(option) + " |\n";
    }
  }
  page += "\n## Formats of meshes\n| name | endings | | read | written |\n|---|---|---|---|---|\n";
  for (const Json& format : usage["formats"]) {
    std::string endings;
    for (const Json& ending : format["endings"])
      endings += (endings.empty() ? "`" : " `") + ending.get<std::string>() + "`";
    page += "| `" + format["name"].get<std::string>() + "` | " + endings + " | " + cell(format["description"]) + " | " +
            (format["readable"] ? "yes" : "") + " | " + (format["writable"] ? "yes" : "") + " |\n";
  }
  return page;
}

// Shells ----------------------------------------------------------------------------------------------------------

// In single quotes, for bash, zsh and fish alike.
std::string singleQuoted(const std::string& text) {
  std::string out = "'";
  for (char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::string verbsOf(const Json& usage) {
  std::string verbs;
  for (const Json& command : usage["commands"])
    verbs += (verbs.empty() ? "" : " ") + command["command"].get<std::string>();
  return verbs;
}

// The values of an option that takes only certain words, separated by spaces; empty for other options.
std::string wordsOf(const Json& usage, const Json& option) {
  if (option["type"] == "choice") return joined(option["choices"], " ");
  std::string words = option.value("unit", "");
  if (words.find('|') != std::string::npos) {
    std::ranges::replace(words, '|', ' ');
    return words;
  }
  if (option["name"] != "--format") return {};
  Json names = Json::array();
  for (const Json& format : usage["formats"])
    if (format["writable"]) names.push_back(format["name"]);
  return joined(names, " ");
}

std::string bash(const Json& usage) {
  std::string text =
      "# bash completion for coastmesh, made by `coastmesh --usage-as bash`\n_coastmesh() {\n"
      "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} verb=${COMP_WORDS[1]} words=\n"
      "  COMPREPLY=()\n"
      "  if ((COMP_CWORD == 1)); then\n    mapfile -t COMPREPLY < <(compgen -W '" +
      verbsOf(usage) + " --help --version' -- \"$word\")\n    return\n  fi\n  case $verb in\n";
  for (const Json& command : usage["commands"]) {
    std::string names = "--help";
    std::string cases;
    std::string valued;
    for (const Json& option : command["options"]) {
      std::string pattern;
      for (const Json& name : option["names"]) {
        names += " " + name.get<std::string>();
        pattern += (pattern.empty() ? "" : "|") + name.get<std::string>();
      }
      if (const std::string words = wordsOf(usage, option); !words.empty()) {
        cases += glued({"        ", pattern, ") words='", words, "' ;;\n"});
      } else if (option["type"] == "number" || option["type"] == "integer") {
        valued += (valued.empty() ? "" : "|") + pattern;
      }
    }
    text += "    " + command["command"].get<std::string>() + ")\n      case $before in\n" + cases;
    if (!valued.empty()) text += "        " + valued + ") return ;;\n";
    text += "        *) if [[ $word == -* ]]; then words='" + names + "'; fi ;;\n      esac ;;\n";
  }
  return text +
         "  esac\n  if [[ -n $words ]]; then\n    mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$word\")\n  "
         "else\n"
         "    compopt -o filenames 2>/dev/null\n    mapfile -t COMPREPLY < <(compgen -f -- \"$word\")\n  fi\n}\n"
         "complete -F _coastmesh coastmesh\n";
}

// Escapes what the brackets of _arguments may not hold: brackets, colons and backslashes.
std::string zshHelp(const std::string& help) {
  std::string out;
  for (char c : help) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') out += '\\';
    out += c;
  }
  return out;
}

std::string zsh(const Json& usage) {
  std::string text =
      "#compdef coastmesh\n# zsh completion for coastmesh, made by `coastmesh --usage-as zsh`\n_coastmesh() {\n"
      "  local -a verbs\n  verbs=(\n";
  for (const Json& command : usage["commands"]) {
    text += "    " + singleQuoted(command["command"].get<std::string>() + ":" + zshHelp(command["help"])) + "\n";
  }
  text +=
      "  )\n  if ((CURRENT == 2)); then\n    _describe -t commands command verbs\n    return\n  fi\n"
      "  local verb=$words[2]\n  shift words\n  ((CURRENT--))\n  case $verb in\n";
  for (const Json& command : usage["commands"]) {
    text += "    " + command["command"].get<std::string>() + ")\n      _arguments '--help[show all options]' \\\n";
    for (const Json& option : command["options"]) {
      for (const Json& name : option["names"]) {
        std::string spec = (option.value("multiple", false) ? "*" : "") + name.get<std::string>();
        const bool opposite = name.get<std::string>().starts_with("--no-");
        spec += "[" + zshHelp((opposite ? "not: " : "") + option["help"].get<std::string>()) + "]";
        if (const std::string words = wordsOf(usage, option); !words.empty()) {
          spec += ":value:(" + words + ")";
        } else if (option["type"] == "file") {
          spec += ":file:_files";
        } else if (option["type"] != "flag") {
          spec += ":" + zshHelp(valueOf(option)) + ":";
        }
        text += "        " + singleQuoted(spec) + " \\\n";
      }
    }
    text += "        '*:file:_files' ;;\n";
  }
  return text + "  esac\n}\n_coastmesh \"$@\"\n";
}

std::string fish(const Json& usage) {
  std::string text = "# fish completion for coastmesh, made by `coastmesh --usage-as fish`\n";
  const std::string verbs = verbsOf(usage);
  for (const Json& command : usage["commands"]) {
    const std::string verb = command["command"];
    text += glued({"complete -c coastmesh -n 'not __fish_seen_subcommand_from ", verbs, "' -f -a ", verb, " -d ",
                   singleQuoted(command["help"]), "\n"});
    for (const Json& option : command["options"]) {
      std::string line = "complete -c coastmesh -n '__fish_seen_subcommand_from " + verb + "'";
      for (const Json& name : option["names"]) {
        const std::string word = name;
        line += word.starts_with("--") ? " -l " + word.substr(2) : " -s " + word.substr(1);
      }
      if (const std::string words = wordsOf(usage, option); !words.empty()) {
        line += " -x -a " + singleQuoted(words);
      } else if (option["type"] == "file") {
        line += " -r -F";
      } else if (option["type"] != "flag") {
        line += " -x";
      }
      text += line + " -d " + singleQuoted(option["help"]) + "\n";
    }
  }
  return text;
}

}  // namespace

std::vector<std::string> usageForms(const std::string& usage_json) {
  std::vector<std::string> forms = {"markdown", "bash", "zsh", "fish", "man"};
  const Json usage = Json::parse(usage_json);
  for (const Json& command : usage["commands"]) forms.push_back("man:" + command["command"].get<std::string>());
  return forms;
}

std::string usageAs(const std::string& form, const std::string& usage_json) {
  const Json usage = Json::parse(usage_json);
  if (form == "markdown") return markdown(usage);
  if (form == "bash") return bash(usage);
  if (form == "zsh") return zsh(usage);
  if (form == "fish") return fish(usage);
  if (form == "man") return manOfAll(usage);
  if (form.starts_with("man:")) return manOf(usage, commandNamed(usage, form.substr(4)));
  std::string known;
  for (const std::string& each : usageForms(usage_json)) known += (known.empty() ? "" : ", ") + each;
  throw OptionError("--usage-as: '" + form + "' is none of " + known);
}

}  // namespace coastmesh
