#pragma once

#include <optional>
#include <string>

#include "apps/usage/option_table.hpp"

namespace coastmesh {

// Options as the keywords of a call: "--size-shore" is size_shore.
std::string keywordOf(const std::string& name);

// The option of a keyword; nullopt if there is none. `former`: the keyword is its former name.
struct KeywordOption {
  const OptionTable::Entry* entry = nullptr;
  bool former = false;
};
std::optional<KeywordOption> optionOf(const std::string& keyword, const OptionTable& table);

// A message with options named as keywords: "--grade needs --coast follow" is "grade needs coast='follow'", and
// "--no-cut" is "cut=False". Everything else, such as names of files, is unchanged.
std::string inKeywords(const std::string& message, const OptionTable& table);

}  // namespace coastmesh
