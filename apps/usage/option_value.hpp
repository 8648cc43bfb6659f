#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace coastmesh {

// A value of an option: of a flag, a number, an integer, a text (a file, a choice), or numbers.
using OptionValue = std::variant<bool, double, std::uint64_t, std::string, std::vector<double>>;

enum class OptionKind { Flag, Number, Integer, Numbers, Text, File, Choice };

// "--coarsen,!--no-coarsen" as the names that a user may type.
std::vector<std::string> namesIn(const std::string& declared);

// A text as a value of that kind, always in the C locale. A text that is no number becomes NaN; one that is no whole
// number or no list of numbers stays a text: OptionTable rejects both with the option's range. An empty text is an
// empty list.
OptionValue valueOf(const std::string& text, OptionKind kind);

}  // namespace coastmesh
