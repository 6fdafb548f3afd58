// SPDX-License-Identifier: Apache-2.0
// media {}
#include <algorithm>

#include "importers/povray/read/reader.h"
#include "importers/povray/read/surface.h"

namespace vitrail::pov {

namespace {

void read_scattering(Reader& reader, MediaBlock& media) {
  reader.expect('{', "behind scattering");
  media.scattering_type = reader.integer("the type of scattering");
  if (media.scattering_type < 1 || media.scattering_type > 5)
    reader.fail("the type of scattering is a number from 1 to 5", reader.here());
  reader.comma();
  media.scattering = reader.color();
  for (;;) {
    reader.comma();
    if (reader.accept(Word::eccentricity_))
      media.eccentricity = reader.number("eccentricity");
    else if (reader.accept(Word::extinction_))
      media.extinction = std::max(reader.number("extinction"), 0.0);
    else
      break;
  }
  reader.expect('}', "at the end of scattering");
}

// How POV-Ray samples along a ray: false where it is none of that.
bool skip_sampling(Reader& reader, Word word) {
  switch (word) {
    case Word::method_:
    case Word::intervals_:
    case Word::confidence_:
    case Word::variance_:
    case Word::ratio_:
    case Word::jitter_:
    case Word::aa_level_:
    case Word::aa_threshold_:
    case Word::collect_:
      reader.number("a part of media");
      return true;
    case Word::samples_:
      reader.number("samples");
      reader.comma();
      if (reader.number_follows()) reader.number("samples");
      return true;
    default:
      return false;
  }
}

bool read_media_part(Reader& reader, MediaBlock& media, Word word) {
  switch (word) {
    case Word::absorption_:
      media.absorption = reader.color();
      return true;
    case Word::emission_:
      media.emission = reader.color();
      return true;
    case Word::scattering_:
      read_scattering(reader, media);
      return true;
    case Word::density_:
      media.densities.push_back(read_pigment_block(reader));
      return true;
    default:
      return skip_sampling(reader, word);
  }
}

}  // namespace

Shared<MediaBlock> read_media_block(Reader& reader) {
  if (const auto named = reader.identifier<Shared<MediaBlock>>()) return *named;
  reader.expect('{', "behind media");
  MediaBlock media;
  media.place = reader.here();
  for (;;) {
    reader.comma();
    if (const auto named = reader.identifier<Shared<MediaBlock>>()) {
      media = **named;
      continue;
    }
    Transform step;
    if (read_transform(reader, step)) {
      media.to_object = step * media.to_object;
      continue;
    }
    const Token token = reader.next();
    if (token.is('}')) break;
    if (token.kind != TokenKind::word || !read_media_part(reader, media, token.symbol->word))
      reader.unexpected(token, "a part of media");
  }
  return std::make_shared<MediaBlock>(std::move(media));
}

Shared<Interior> moved(const Shared<Interior>& interior, const Transform& by) {
  if (interior->media.empty()) return interior;
  auto result = std::make_shared<Interior>(*interior);
  for (Shared<MediaBlock>& media : result->media) {
    auto there = std::make_shared<MediaBlock>(*media);
    there->to_object = by * there->to_object;
    media = there;
  }
  return result;
}

}  // namespace vitrail::pov
