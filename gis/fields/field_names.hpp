#pragma once

#include <string>
#include <string_view>

namespace coastmesh {

// What is known of a nodal attribute that models use.
struct FieldName {
  std::string_view name;   // ADCIRC's
  std::string_view alias;  // a shorter name for the same, and that of SCHISM's file; empty: none
  std::string_view unit;
  std::string_view long_name;
  std::string_view standard_name;  // of CF; empty: none
  double usual;                    // where the attribute has no effect; NaN: nowhere
  bool is_state = false;           // 0 or 1, and nothing between
};

// Null for a name that is not known, of either kind.
const FieldName* findFieldName(std::string_view name);

// True for an attribute, by its full name, whose values are not interpolated.
bool isState(std::string_view name);

// ADCIRC's name of an attribute that it knows, otherwise `name`.
std::string fullFieldName(const std::string& name);
// The shorter name of an attribute if it has one, otherwise `name`, as a word.
std::string shortFieldName(const std::string& name);
// With characters replaced that file names and variables may not have.
std::string asWord(std::string name);
// A word as TELEMAC writes names of variables: capitals, blanks, 16 characters at most.
std::string telemacWord(std::string word);
// TELEMAC's name of an attribute. Friction of any law has one name.
std::string telemacFieldName(const std::string& name);
// The reverse, for attributes that are known: friction has the law of its unit, otherwise it is "friction". Empty for
// any other variable.
std::string fieldOfTelemac(const std::string& variable, const std::string& unit);

// What is wrong with the name of an attribute, as the end of a sentence about it ("is not ..."); empty if nothing:
// letters, digits and underscores, the first a letter, and none that a file of a model has for something else.
std::string wrongFieldName(const std::string& name);

}  // namespace coastmesh
