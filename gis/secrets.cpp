#include "gis/secrets.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>

#include "gis/lower_case.hpp"

namespace coastmesh {

namespace {

constexpr std::string_view kMask = "***";
constexpr std::string_view kBlanks = " \t\r\n";

// What a name ends with whose value is secret: "password", "sslpassword", "access_token", "X-Amz-Signature".
constexpr std::array<std::string_view, 10> kNames = {"password", "passwd",  "passphrase", "pwd",       "token",
                                                     "secret",   "api_key", "apikey",     "signature", "sig"};

bool isOfName(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-'; }

bool namesSecret(std::string_view text, std::size_t end) {
  std::size_t begin = end;
  while (begin > 0 && isOfName(text[begin - 1])) --begin;
  const std::string name = lowerCase(std::string(text.substr(begin, end - begin)));
  return std::ranges::any_of(kNames, [&](std::string_view wanted) {
    // "sig" is a parameter of its own, not the end of a word.
    return wanted == "sig" ? name == wanted : name.ends_with(wanted);
  });
}

// The end of a value that begins at `at`. A quote or brace that is not closed ends with the text.
std::size_t endOfValue(std::string_view text, std::size_t at) {
  constexpr std::string_view kOpening = "'\"{", kClosing = "'\"}";
  const std::size_t bracket = at < text.size() ? kOpening.find(text[at]) : kOpening.npos;
  if (bracket == kOpening.npos) return std::min(text.find_first_of(" \t\r\n,;&'\"|", at), text.size());
  for (std::size_t i = at + 1; i < text.size(); ++i) {
    if (text[i] == kClosing[bracket]) return i + 1;
    if (text[i] == '\\') ++i;
  }
  return text.size();
}

// The end of the name before a "=" at `equals`, with blanks between.
std::size_t endOfName(std::string_view text, std::size_t equals) {
  const std::size_t last = equals == 0 ? text.npos : text.find_last_not_of(kBlanks, equals - 1);
  return last == text.npos ? 0 : last + 1;
}

void maskValues(std::string& text) {
  for (std::size_t at = text.find('='); at != text.npos; at = text.find('=', at + 1)) {
    if (!namesSecret(text, endOfName(text, at))) continue;
    const std::size_t begin = std::min(text.find_first_not_of(kBlanks, at + 1), text.size());
    text.replace(begin, endOfValue(text, begin) - begin, kMask);
  }
}

void maskUrls(std::string& text) {
  constexpr std::string_view kMark = "://";
  for (std::size_t at = text.find(kMark); at != text.npos; at = text.find(kMark, at + 1)) {
    const std::size_t begin = at + kMark.size();
    const std::size_t end = std::min(text.find_first_of(" \t\r\n/?#'\"", begin), text.size());
    const std::size_t host = text.substr(begin, end - begin).rfind('@');
    const std::size_t colon = text.find(':', begin);
    if (host == text.npos || colon == text.npos || colon >= begin + host) continue;
    text.replace(colon + 1, begin + host - colon - 1, kMask);
  }
}

}  // namespace

std::string withoutSecrets(std::string_view text) {
  std::string shown(text);
  maskValues(shown);
  maskUrls(shown);
  return shown;
}

}  // namespace coastmesh
