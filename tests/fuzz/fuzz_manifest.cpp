// SPDX-License-Identifier: Apache-2.0
// A manifest that is JSON, with the records of the sample beside it; its checksum is put right.
#include "bundle/checked_json.h"
#include "bundle/manifest.h"
#include "tests/bundle/sample_bundle.h"
#include "tests/fuzz/fuzz_reader.h"

namespace {

const std::filesystem::path& bundle() {
  static const std::filesystem::path written = [] {
    vitrail::write_manifest(vitrail::fuzz::folder(), vitrail::test::sample_manifest());
    return vitrail::fuzz::folder();
  }();
  return written;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vitrail;
  auto json = nlohmann::ordered_json::parse(data, data + size, nullptr, false);
  if (!json.is_object()) return 0;
  json.erase("checksum");
  if (json.empty()) return 0;
  try {
    write_checked_json(bundle() / "manifest.json", json);
  } catch (const nlohmann::json::exception&) {  // not UTF-8
    return 0;
  }
  return fuzz::run([&] { static_cast<void>(read_manifest(bundle())); });
}
