#pragma once

#include <string>
#include <string_view>

namespace coastmesh {

// A text for people, with "***" in place of passwords and keys: the values of `password=…`, `pwd=…`, `token=…` and the
// like, bare, quoted or in braces, as in connection strings of databases and in URLs, and what is between user and host
// in "scheme://user:password@host".
std::string withoutSecrets(std::string_view text);

}  // namespace coastmesh
