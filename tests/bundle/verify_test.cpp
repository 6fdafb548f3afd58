// SPDX-License-Identifier: Apache-2.0
// What verify_bundle says of bundles whose files are whole and do not fit together, and how it goes on.
#include "bundle/verify.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "bundle/checksum.h"
#include "bundle/domain_layout.h"
#include "scene/system/diagnostics.h"
#include "tests/bundle/sample_bundle.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::verify_test {

namespace {

using test::SampleBundle;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class Verify : public ::testing::Test {
 protected:
  Verify() { test::write(sample, bundle); }

  std::string problems(int threads = 1) const {
    std::string text;
    for (const VerifyFinding& f : verify_bundle(bundle, {threads}).problems)
      text += f.file + ": " + f.what + "\n";
    return text;
  }
  // Of the bundle with a change.
  std::string problems_with(const std::function<void(SampleBundle&)>& harm) {
    SampleBundle changed = test::whole_bundle();
    harm(changed);
    test::write(changed, bundle);
    return problems();
  }
  void damage(const std::string& file) const {
    std::string text = test::read_text(bundle / file);
    text[text.size() / 2] = static_cast<char>(text[text.size() / 2] ^ 1);
    test::write_text(bundle / file, text);
  }

  test::TemporaryDirectory directory;
  std::filesystem::path bundle = directory / "a.vit";
  SampleBundle sample = test::whole_bundle();
};

TEST_F(Verify, CountsAWholeBundle) {
  std::uint64_t bytes = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(bundle))
    if (entry.is_regular_file()) bytes += entry.file_size();
  double read = 0;
  const VerifyResult r = verify_bundle(bundle, {2, [&](double fraction) { read = fraction; }});
  EXPECT_TRUE(r.problems.empty() && r.warnings.empty()) << problems();
  EXPECT_EQ(r.files, 10u);
  EXPECT_EQ(r.bytes, bytes);
  EXPECT_EQ(read, 1);
  ASSERT_TRUE(r.census);
  EXPECT_TRUE(r.census->ghost_free());
  EXPECT_EQ(r.census->cut_triangles, 1u);
  EXPECT_EQ(r.census->pieces, 2u);
}

TEST_F(Verify, NamesEveryDamagedFile) {
  for (const char* file : {"domains/000000.dom", "objects/000001.dom", "textures/000000.tex"}) damage(file);
  std::filesystem::remove(bundle / "domains/000002.dom");
  const VerifyResult r = verify_bundle(bundle);
  ASSERT_EQ(r.problems.size(), 4u) << problems();
  EXPECT_EQ(r.problems[0].file, "domains/000000.dom");
  EXPECT_THAT(r.problems[0].what, HasSubstr("normals (bytes 1664 to 1920)"));
  EXPECT_EQ(r.problems[1].file, "domains/000002.dom");
  EXPECT_THAT(r.problems[1].what, HasSubstr("No such file"));
  EXPECT_EQ(r.problems[2].file, "objects/000001.dom");
  EXPECT_EQ(r.problems[3].file, "textures/000000.tex");
  EXPECT_FALSE(r.census);
  EXPECT_EQ(problems(1), problems(3));
}

TEST_F(Verify, GoesOnWithoutAManifest) {
  for (const char* file :
       {"manifest.json", "lights.bin", "domains.bin", "domains/000001.dom", "textures/000000.tex"})
    damage(file);
  for (const char* file :
       {"manifest.json: ", "lights.bin: ", "domains.bin: ", "domains/000001.dom: ", "textures/000000.tex: "})
    EXPECT_THAT(problems(), HasSubstr(file));
  std::filesystem::remove(bundle / "manifest.json");
  EXPECT_THAT(problems(), HasSubstr("domains/000001.dom: "));
  EXPECT_THROW(verify_bundle(directory / "none.vit"), Error);
}

// A manifest with a wrong checksum still lists textures, domains.bin domains; without either numbers have no
// gaps and instances refer to objects.
TEST_F(Verify, MissesFilesWithoutAManifest) {
  const auto missing = [&] {
    std::vector<std::string> files;
    for (const VerifyFinding& f : verify_bundle(bundle).problems)
      if (f.what.find("No such file") != std::string::npos) files.push_back(f.file);
    return files;
  };
  const std::string text = test::read_text(bundle / "manifest.json");
  std::filesystem::remove(bundle / "domains/000000.dom");
  std::filesystem::remove(bundle / "domains/000002.dom");
  std::filesystem::remove(bundle / "textures/000000.tex");
  test::write_text(bundle / "manifest.json", text + " ");
  EXPECT_THAT(missing(), ElementsAre("domains/000000.dom", "domains/000002.dom", "textures/000000.tex"));
  test::write_text(bundle / "manifest.json", text.substr(0, text.size() / 2));
  EXPECT_THAT(missing(), ElementsAre("domains/000000.dom", "domains/000002.dom"));
  damage("domains.bin");
  EXPECT_THAT(missing(), ElementsAre("domains/000000.dom"));
  std::filesystem::remove(bundle / "objects/000001.dom");
  EXPECT_THAT(missing(), ElementsAre("domains/000000.dom", "objects/000001.dom"));
  for (const char* other : {"[1]", R"({"texture_files": {"a": 1}})", "{\"texture_files\": [", ""}) {
    test::write_text(bundle / "manifest.json", other);
    EXPECT_THAT(missing(), ElementsAre("domains/000000.dom", "objects/000001.dom")) << other;
  }
}

TEST_F(Verify, WarnsOfWhatDoesNotBelong) {
  test::SampleBundle other = test::whole_bundle();
  std::filesystem::create_directory(bundle / "spill");
  std::filesystem::copy_file(bundle / "domains/000000.dom", bundle / "domains/000003.dom");
  const VerifyResult r = verify_bundle(bundle);
  EXPECT_TRUE(r.problems.empty());
  ASSERT_EQ(r.warnings.size(), 2u);
  EXPECT_EQ(r.warnings[0].file, "domains/000003.dom");
  EXPECT_EQ(r.warnings[1].file, "spill");
}

TEST_F(Verify, FindsWhatIsNotStoredOnce) {
  EXPECT_THAT(problems_with([](SampleBundle& b) {
                b.domains[1].clusters[0].id[4] = 4;
                b.manifest.domains[1].triangles = 2;
              }),
              HasSubstr("domains: 1 triangles or pieces are stored more than once"));
  EXPECT_THAT(problems_with([](SampleBundle& b) {
                b.domains[0].clusters[0].id[4] = no_triangle;
                b.manifest.domains[0].triangles = 10;
              }),
              HasSubstr("domains: 1 triangles are in none"));
  EXPECT_THAT(problems_with([](SampleBundle& b) {
                b.domains[0].clusters[1].id[3] = 12;
                b.manifest.domains[0].triangles = 12;
              }),
              HasSubstr("domains: 1 triangles or pieces are where they should not be"));
  EXPECT_THAT(problems_with([](SampleBundle& b) { b.domains[0].pieces[0].triangle = 20; }),
              HasSubstr("domains/000000.dom: domain file is damaged: it has a piece of triangle 20, which"));
  EXPECT_THAT(problems_with([](SampleBundle& b) {
                b.domains[1].piece_vertices[0] = {3.4, 3, 3.6};
              }),
              HasSubstr("domains: pieces do not tile"));
  EXPECT_THAT(problems_with([](SampleBundle& b) { b.manifest.cut_triangles = 2; }),
              HasSubstr("1 triangles are cut, and 2 should be"));
  EXPECT_THAT(problems_with([](SampleBundle& b) { b.objects[1].clusters[0].id[1] = no_triangle; }),
              HasSubstr("objects/000001.dom: 1 triangles are in none"));
}

TEST_F(Verify, FindsWhatTheManifestContradicts) {
  EXPECT_THAT(problems_with([](SampleBundle& b) { b.manifest.domains[1].triangles = 3; }),
              HasSubstr("domains/000001.dom: it does not hold as many"));
  EXPECT_THAT(problems_with([](SampleBundle& b) { b.manifest.domains[1].instances = 2; }),
              HasSubstr("domains/000001.dom: it does not hold as many"));
  EXPECT_THAT(problems_with([](SampleBundle& b) { b.manifest.domains[0].tight_bounds.upper.y = 9; }),
              HasSubstr("domains/000000.dom: it reaches beyond"));
  EXPECT_THAT(problems_with([](SampleBundle& b) { b.manifest.domains[0].occupancy = {}; }),
              HasSubstr("domains/000000.dom: it holds something where"));
  EXPECT_THAT(problems_with([](SampleBundle& b) { b.domains[0].uvs.clear(); }),
              HasSubstr("domains/000000.dom: it does not hold the normals or (u,v)"));
}

// Two parts of one prototype go together.
TEST_F(Verify, FindsMissingParts) {
  const auto in_two_parts = [](SampleBundle& b) {
    b.objects.push_back(b.objects[0]);
    b.manifest.objects.push_back(b.manifest.objects[0]);
    b.manifest.objects[2].first_surface = b.manifest.objects[1].first_surface;
    b.manifest.objects[2].surface_count = 2;
    b.manifest.objects[2].triangles = 4;
    b.objects[2].clusters[0].id[0] = 1, b.objects[2].clusters[0].id[1] = no_triangle;
    b.objects[1].clusters[0].id[1] = no_triangle;
    for (DomainInfo& d : b.manifest.domains) d.objects = {0, 1, 2};
  };
  const std::string missing = problems_with(in_two_parts);
  EXPECT_EQ(missing, "domains: it has an instance of object 1, but not of its other part 2\n");
  EXPECT_EQ(problems_with([&](SampleBundle& b) {
              in_two_parts(b);
              for (DomainContent& d : b.domains) {
                d.instances.push_back(test::sample_instance(2, 11));
                BvhNode& root = d.instance_nodes[0];
                root.child[1] = BvhNode::cluster_bit | 1;
                for (int axis = 0; axis < 3; ++axis) root.lower[axis][1] = -10, root.upper[axis][1] = 10;
              }
              for (DomainInfo& d : b.manifest.domains) d.instances = 2;
            }),
            "");
}

// ---- Features that a later program might write

class Features : public Verify {
 protected:
  // Changes the header of domain 0, its table and what follows, and makes checksum and manifest right.
  void rewrite(const std::function<void(layout::DomainHeader&)>& change, bool with_section = false) {
    const std::filesystem::path file = domain_path(bundle, 0);
    std::string text = test::read_text(file);
    layout::DomainHeader header;
    std::memcpy(&header, text.data(), sizeof header);
    if (with_section) {  // a section of kind 100, one element of 64 bytes
      const std::string content(128, '\7');
      const std::uint64_t end = layout::header_bytes(header.sections),
                          longer = layout::header_bytes(header.sections + 1) - end;
      text.insert(end, longer, '\0');
      const std::span table(reinterpret_cast<layout::Section*>(text.data() + sizeof header),
                            ++header.sections);
      for (layout::Section& s : table) s.offset += longer;
      table.back() = {text.size(), 1, checksum(std::as_bytes(std::span(content))), 64, 100};
      text += content;
      header.file_bytes = text.size();
    }
    change(header);
    const std::span bytes = std::as_bytes(std::span(text));
    header.header_checksum = layout::checksum_of(
        header, bytes.subspan(sizeof header, layout::header_bytes(header.sections) - sizeof header));
    text.replace(0, sizeof header, reinterpret_cast<const char*>(&header), sizeof header);
    test::write_text(file, text);
    sample.manifest.domains[0].bytes = text.size();
    sample.manifest.domains[0].hash = header.header_checksum;
    write_manifest(bundle, sample.manifest);
  }
};

TEST_F(Features, RequiredOnesAreRefusedByName) {
  rewrite([](layout::DomainHeader& h) { h.features.required |= 1u << 31; });
  EXPECT_THAT(problems(), HasSubstr("domains/000000.dom: it needs 'skies', which this program does not"));
  rewrite([](layout::DomainHeader& h) { h.features.required = 0; });
  EXPECT_THAT(problems(), HasSubstr("features are not those of its sections"));
}

TEST_F(Features, OptionalOnesAreIgnored) {
  rewrite([](layout::DomainHeader& h) { h.features.optional |= 1u << 7; }, true);
  EXPECT_EQ(problems(), "");
  std::string text = test::read_text(domain_path(bundle, 0));
  text[text.size() - 128] = '\6';
  test::write_text(domain_path(bundle, 0), text);
  EXPECT_NO_THROW(MappedDomain{domain_path(bundle, 0)});
  EXPECT_THAT(problems(), HasSubstr("wrong checksum of kind 100"));
}

}  // namespace

}  // namespace vitrail::verify_test
