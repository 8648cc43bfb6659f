#include "gis/sample/pixel_classes.hpp"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <string_view>

#include "gis/error.hpp"
#include "gis/file/text_reader.hpp"
#include "gis/places.hpp"

namespace coastmesh {

namespace {

std::string numberText(double number) {
  char text[40];
  std::snprintf(text, sizeof text, "%.10g", number);
  return text;
}

// Spreadsheets put this before the first character of a file.
std::string_view withoutMark(std::string_view word) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  return word.starts_with(kMark) ? word.substr(kMark.size()) : word;
}

// A title has a letter where numbers have none.
bool isTitle(std::string_view word) {
  return std::ranges::any_of(word, [](unsigned char c) {
    return std::isalpha(c) != 0 && std::string_view("eEdD").find(c) == std::string::npos;
  });
}

}  // namespace

PixelClasses::PixelClasses(const std::string& path) : path_(path) {
  TextReader file(path, '#', " \t\r,;\"");
  for (bool is_first = true; file.nextLine(); is_first = false) {
    if (!file.hasWord()) continue;
    std::string_view word = is_first ? withoutMark(file.word()) : file.word();
    if (word.empty()) word = file.word();  // the mark was before a quote
    if (is_first && isTitle(word)) continue;
    const double pixel_class = file.numberIn(word);
    if (!file.hasWord()) file.fail("class " + numberText(pixel_class) + " has no value: a line is a class and a value");
    const double value = file.number();
    if (file.hasWord()) file.fail("it has more than two columns: a line is a class and a value");
    sorted_.emplace_back(pixel_class, value);
  }
  std::ranges::sort(sorted_);
  const auto repeated = std::ranges::unique(sorted_);
  sorted_.erase(repeated.begin(), repeated.end());
  const auto twice = std::ranges::adjacent_find(sorted_, {}, &std::pair<double, double>::first);
  if (twice != sorted_.end())
    throw InputError("'" + path + "' has two values for class " + numberText(twice->first) + ", " +
                     numberText(twice->second) + " and " + numberText(std::next(twice)->second));
  if (sorted_.empty())
    throw InputError("'" + path + "' has no classes: a line is a class and a value, such as 11,0.02");
}

std::optional<double> PixelClasses::valueOf(double pixel_class) const {
  const auto found = std::ranges::lower_bound(sorted_, pixel_class, {}, &std::pair<double, double>::first);
  if (found == sorted_.end() || found->first != pixel_class) return std::nullopt;
  return found->second;
}

void PixelClasses::failAt(const RasterBand& raster, std::int64_t column, std::int64_t row) const {
  const double found = raster.read({column, row, 1, 1}).front();
  const Point place = raster.geometry().placeOf({static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5});
  throw InputError("'" + raster.path() + "' has class " + numberText(found) + " at (" + roughPlaceInWords(place) +
                   "), in its own coordinates, which '" + path_ +
                   "' lacks: add a line with its value, or have the raster say that the class means no data");
}

}  // namespace coastmesh
