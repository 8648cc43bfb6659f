#include "apps/cli/shard_file.hpp"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "apps/job/bytes.hpp"
#include "apps/job/group_bytes.hpp"
#include "gis/error.hpp"
#include "parallel/byte_hash.hpp"

namespace coastmesh {

// Found by argument-dependent lookup from `pass`.
auto partsOf(auto& header) requires std::is_same_v<std::remove_cvref_t<decltype(header)>, ShardHeader> {
  auto& [version, options, shard, shards, exit_code, input_digest, groups, left] = header;
  return std::tie(version, options, shard, shards, exit_code, input_digest, groups, left);
}
namespace {

constexpr std::string_view kMagic = "coastmesh shard\n";
constexpr const char* kEnding = ".shard";
constexpr std::uint64_t kMostNamed = 20;  // missing shards that a message lists

// Thrown by readers of a file that may be cut short.
struct EndsTooEarly : InputError {
  using InputError::InputError;
};

std::string contentsOf(const std::string& path, std::size_t most) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (is_directory(status)) throw InputError("'" + path + "' is a folder, not a file written by mesh --shard");
  if (exists(status) && !is_regular_file(status)) throw InputError("'" + path + "' is not a regular file");
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError("there is no file '" + path + "', or it cannot be read");
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) throw InputError("'" + path + "' cannot be read: " + error.message());
  std::string bytes;
  bytes.resize(std::min<std::uintmax_t>(most, size));
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!file) throw InputError("'" + path + "' cannot be read");
  return bytes;
}

[[noreturn]] void refuseOtherKind(const std::string& path) {
  throw InputError("'" + path + "' was not written by mesh --shard");
}

template <typename Error>
ShardHeader readHeader(BasicByteReader<Error>& reader, const std::string& path) {
  std::string magic(kMagic.size(), ' ');
  for (char& c : magic) reader.pass(c);
  if (magic != kMagic) refuseOtherKind(path);
  ShardHeader header;
  reader.pass(header.version);
  if (header.version != COASTMESH_VERSION)
    throw InputError("'" + path + "' was made by coastmesh " + header.version + ", this is " + COASTMESH_VERSION +
                     ": make it again");
  reader.pass(header);
  return header;
}

std::uint64_t checksumOf(std::string_view bytes) {
  ByteHash hash;
  hash.add(bytes);
  return hash.value();
}

constexpr std::size_t kSumBytes = sizeof(std::uint64_t);

// The content before the checksum, which must match: later readers do not check values, and a damaged index of a node
// may be out of range.
std::string_view unsealed(const std::string& bytes, const std::string& path) {
  std::uint64_t sum = 0;
  if (bytes.size() < kSumBytes) throw InputError("'" + path + "' ends too early");
  const std::string_view content = std::string_view(bytes).substr(0, bytes.size() - kSumBytes);
  std::memcpy(&sum, bytes.data() + content.size(), kSumBytes);
  if (sum != checksumOf(content)) throw InputError("'" + path + "' is damaged, or not whole: make it again");
  return content;
}

std::string numbered(std::uint32_t shard, std::uint32_t shards) {
  return std::to_string(shard + 1) + '/' + std::to_string(shards);
}

}  // namespace

std::string sealedShard(std::string bytes) {
  const std::uint64_t sum = checksumOf(bytes);
  bytes.append(reinterpret_cast<const char*>(&sum), sizeof sum);
  return bytes;
}

bool isShardFile(const std::string& path) { return path.ends_with(kEnding); }

std::vector<std::string> withoutShardFiles(const std::vector<std::string>& paths) {
  std::vector<std::string> others;
  std::ranges::remove_copy_if(paths, std::back_inserter(others), isShardFile);
  return others;
}

GivenOptions givenOptions(const OptionTable& table, const OptionTable& of_job) {
  GivenOptions options;
  for (const OptionTable::Entry* entry : of_job.entries()) {
    if (entry->name == "--threads") continue;
    for (const OptionValue& value : table.given(entry->name)) options.emplace_back(entry->name, value);
  }
  return options;
}

namespace {

// nullopt if the file ends within the header.
std::optional<ShardHeader> headerOf(const std::string& path) {
  // Enough for most; thousands of inputs with long names need more.
  constexpr std::size_t kAtFirst = 1 << 20, kGrowth = 8;
  for (std::size_t most = kAtFirst;; most *= kGrowth) {
    const std::string bytes = contentsOf(path, most);
    if (!kMagic.starts_with(bytes.substr(0, kMagic.size()))) refuseOtherKind(path);
    BasicByteReader<EndsTooEarly> reader(bytes, "'" + path + "'");
    try {
      return readHeader(reader, path);
    } catch (const EndsTooEarly&) {
      if (bytes.size() < most) return std::nullopt;
    }
  }
}

// True if the file ends with the checksum of what comes before. Reads piece by piece: it may be larger than memory.
bool isSealedFile(const std::string& path) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error || size < kSumBytes) return false;
  std::ifstream file(path, std::ios::binary);
  constexpr std::uintmax_t kPiece = 1 << 20;
  std::string piece;
  ByteHash hash;
  for (std::uintmax_t left = size - kSumBytes; left > 0; left -= piece.size()) {
    piece.resize(static_cast<std::size_t>(std::min(left, kPiece)));
    if (!file.read(piece.data(), static_cast<std::streamsize>(piece.size()))) return false;
    hash.add(piece);
  }
  std::uint64_t sum = 0;
  file.read(reinterpret_cast<char*>(&sum), kSumBytes);
  return file && sum == hash.value();
}

}  // namespace

std::optional<ShardHeader> headerOfWholeShard(const std::string& path) {
  std::optional<ShardHeader> header = headerOf(path);
  return header && isSealedFile(path) ? header : std::nullopt;
}

ShardWriter::ShardWriter(GivenOptions options, std::uint32_t shard, std::uint32_t shards) {
  header_.version = COASTMESH_VERSION;
  header_.options = std::move(options);
  header_.shard = shard;
  header_.shards = shards;
}

void ShardWriter::begin(std::uint64_t input_digest, std::size_t groups) {
  header_.input_digest = input_digest;
  header_.groups = groups;
}

void ShardWriter::keep(std::size_t group, const GroupResult& result) {
  std::string bytes = result.lacks_memory ? "" : bytesOf(result);
  const std::lock_guard lock(mutex_);
  header_.left += result.lacks_memory;
  groups_.emplace_back(group, std::move(bytes));
}

std::string ShardWriter::file(int exit_code) const {
  ShardHeader header = header_;
  header.exit_code = exit_code;
  ByteWriter writer;
  for (const char c : kMagic) writer.pass(c);
  writer.pass(header.version);
  writer.pass(header);
  writer.pass(static_cast<std::uint64_t>(groups_.size()));
  std::string bytes = writer.take();
  std::vector<const std::pair<std::uint64_t, std::string>*> order;
  for (const auto& group : groups_) order.push_back(&group);
  std::ranges::sort(order, {}, [](const auto* group) { return group->first; });
  for (const auto* group : order) {
    ByteWriter number;
    number.pass(group->first);
    number.pass(static_cast<std::uint64_t>(group->second.size()));
    bytes += number.take();
    bytes += group->second;
  }
  return sealedShard(std::move(bytes));
}

GatheredShards::GatheredShards(const std::vector<std::string>& paths) : paths_(paths) {
  for (const std::string& path : paths_) contents_.push_back(contentsOf(path, std::string::npos));
  // Numbers in headers are not trusted: nothing is allocated by them.
  std::map<std::uint32_t, std::size_t> file_of;
  for (std::size_t f = 0; f < paths_.size(); ++f) {
    ByteReader anything(contents_[f], "'" + paths_[f] + "'");
    readHeader(anything, paths_[f]);  // reports another kind or version first
    ByteReader reader(unsealed(contents_[f], paths_[f]), "'" + paths_[f] + "'");
    const ShardHeader header = readHeader(reader, paths_[f]);
    if (f == 0) header_ = header;
    if (!header.ofSameRun(header_) || header.shard >= header.shards)
      throw InputError("'" + paths_[f] + "' belongs to another run than '" + paths_[0] +
                       "': other options, or another number of shards");
    if (header.input_digest != header_.input_digest || header.groups != header_.groups)
      throw InputError("'" + paths_[f] + "' was made of another input than '" + paths_[0] + "': make it again");
    const auto [file, added] = file_of.emplace(header.shard, f);
    if (!added)
      throw InputError("'" + paths_[f] + "' and '" + paths_[file->second] + "' are both shard " +
                       numbered(header.shard, header.shards) + ": give it once");
    std::uint64_t count = 0;
    reader.pass(count);
    for (std::uint64_t i = 0; i < count; ++i) {
      std::uint64_t group = 0, size = 0;
      reader.pass(group);
      reader.pass(size);
      if (group >= header_.groups || !places_.emplace(group, Place{f, reader.passView(size)}).second)
        throw InputError("'" + paths_[f] + "' is damaged");
    }
    if (!reader.atEnd()) throw InputError("'" + paths_[f] + "' is longer than it should be");
  }
  const std::uint64_t lacking = header_.shards - file_of.size();
  std::string missing;
  std::uint64_t named = 0;
  for (std::uint32_t shard = 0; named < std::min<std::uint64_t>(lacking, kMostNamed); ++shard) {
    if (file_of.contains(shard)) continue;
    missing += (missing.empty() ? "" : ", ") + numbered(shard, header_.shards);
    ++named;
  }
  if (lacking > named) missing += " and " + std::to_string(lacking - named) + " more";
  if (lacking > 0) {
    throw InputError("of the run of '" + paths_[0] + "' these shards are missing: " + missing +
                     "; run them, then gather all");
  }
  std::uint64_t group = 0;
  while (places_.contains(group)) ++group;
  if (group < header_.groups) {
    throw InputError("group " + std::to_string(group + 1) + " of the run of '" + paths_[0] +
                     "' is in no shard: make them again");
  }
}

void GatheredShards::begin(std::uint64_t input_digest, std::size_t groups) const {
  if (input_digest != header_.input_digest || groups != header_.groups)
    throw InputError("'" + paths_[0] + "' and the others were made of another input than the one that is there now");
}

GroupResult GatheredShards::take(std::size_t group) const {
  const Place& place = places_.at(group);
  return groupFrom(place.bytes, "'" + paths_[place.file] + "'");
}

}  // namespace coastmesh
