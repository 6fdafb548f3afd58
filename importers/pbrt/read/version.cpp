// SPDX-License-Identifier: Apache-2.0
#include "importers/pbrt/read/version.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>

#include "importers/bytes/input_bytes.h"

namespace vitrail::pbrt {

namespace {

struct Hint {
  std::string_view directive, kind;
  Version version;
};

constexpr std::array<Hint, 32> kind_hints{{{"Film", "image", Version::v3},
                                           {"Film", "rgb", Version::v4},
                                           {"Film", "gbuffer", Version::v4},
                                           {"Film", "spectral", Version::v4},
                                           {"Camera", "environment", Version::v3},
                                           {"Camera", "spherical", Version::v4},
                                           {"Integrator", "directlighting", Version::v3},
                                           {"Integrator", "whitted", Version::v3},
                                           {"Integrator", "simplepath", Version::v4},
                                           {"Integrator", "simplevolpath", Version::v4},
                                           {"Integrator", "lightpath", Version::v4},
                                           {"Integrator", "randomwalk", Version::v4},
                                           {"Sampler", "lowdiscrepancy", Version::v3},
                                           {"Sampler", "02sequence", Version::v3},
                                           {"Sampler", "random", Version::v3},
                                           {"Sampler", "zsobol", Version::v4},
                                           {"Sampler", "paddedsobol", Version::v4},
                                           {"Sampler", "independent", Version::v4},
                                           {"AreaLightSource", "area", Version::v3},
                                           {"Material", "matte", Version::v3},
                                           {"Material", "plastic", Version::v3},
                                           {"Material", "uber", Version::v3},
                                           {"Material", "glass", Version::v3},
                                           {"Material", "mirror", Version::v3},
                                           {"Material", "metal", Version::v3},
                                           {"Material", "substrate", Version::v3},
                                           {"Material", "translucent", Version::v3},
                                           {"Material", "diffuse", Version::v4},
                                           {"Material", "dielectric", Version::v4},
                                           {"Material", "conductor", Version::v4},
                                           {"Material", "coateddiffuse", Version::v4},
                                           {"Material", "coatedconductor", Version::v4}}};

constexpr std::array<std::string_view, 4> v3_types{"point ", "vector ", "color ", "xyz "};
constexpr std::array<std::string_view, 4> v4_directives{"ColorSpace", "Option", "Attribute", "Import"};

std::optional<Version> hint_of_directive(std::string_view word) {
  if (word == "WorldEnd") return Version::v3;
  if (std::find(v4_directives.begin(), v4_directives.end(), word) != v4_directives.end()) return Version::v4;
  return std::nullopt;
}

// Of a quoted string: the kind after a directive (or of a named material), or the declaration of a parameter.
std::optional<Version> hint_of_text(std::string_view directive, bool is_kind, std::string_view text) {
  if (is_kind) {
    for (const Hint& hint : kind_hints)
      if (hint.directive == directive && hint.kind == text) return hint.version;
    return std::nullopt;
  }
  for (const std::string_view type : v3_types)
    if (text.starts_with(type)) return Version::v3;
  return std::nullopt;
}

}  // namespace

DetectedVersion detect_version(const std::filesystem::path& file) {
  InputBytes bytes(file);
  const std::string name = file.string();
  Lexer lexer(&name, bytes.begin(), bytes.end());
  std::string directive, previous;
  bool is_kind = false;
  for (;;) {
    const Token token = lexer.next();
    std::optional<Version> hint;
    if (token.kind == TokenKind::end) return {};
    if (token.kind == TokenKind::open && lexer.peek() != '"') {
      lexer.skip_list();
      bytes.release_before(lexer.position());
    } else if (token.kind == TokenKind::word &&
               std::isupper(static_cast<unsigned char>(token.text.front()))) {
      hint = hint_of_directive(token.text);
      directive = token.text;
      is_kind = true;
    } else if (token.kind == TokenKind::text) {
      const bool named_kind = previous == "string type" && directive == "MakeNamedMaterial";
      hint = named_kind ? hint_of_text("Material", true, token.text)
                        : hint_of_text(directive, is_kind, token.text);
      previous = token.text;
      is_kind = false;
    }
    if (hint) return {*hint, true};
  }
}

}  // namespace vitrail::pbrt
