// SPDX-License-Identifier: Apache-2.0
#include "importers/solids/outlines.h"

#include <dlfcn.h>
#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H

#include <memory>

#include "scene/system/diagnostics.h"
#include "scene/system/memory_guard.h"

namespace vitrail::solids {

namespace {

constexpr std::uint64_t library_bytes = 4 << 20;

// The functions that are called, found by name: programs that read no text do not load the library.
struct FreeType {
  decltype(&FT_Init_FreeType) init;
  decltype(&FT_Done_FreeType) done;
  decltype(&FT_New_Face) new_face;
  decltype(&FT_Done_Face) done_face;
  decltype(&FT_Get_Char_Index) char_index;
  decltype(&FT_Load_Glyph) load_glyph;
  decltype(&FT_Get_Kerning) kerning;
  decltype(&FT_Set_Charmap) set_charmap;
  decltype(&FT_Outline_Decompose) decompose;
};

const FreeType& free_type() {
  static const FreeType functions = [] {
    const GrantedMemory loading(library_bytes);
    void* library = ::dlopen("libfreetype.so.6", RTLD_NOW | RTLD_LOCAL);
    if (!library) throw Error("text needs FreeType: install libfreetype6");
    FreeType f{};
    const auto find = [&](auto& function, const char* name) {
      function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(::dlsym(library, name));
      if (!function) throw Error(std::string("libfreetype.so.6 has no ") + name);
    };
    find(f.init, "FT_Init_FreeType");
    find(f.done, "FT_Done_FreeType");
    find(f.new_face, "FT_New_Face");
    find(f.done_face, "FT_Done_Face");
    find(f.char_index, "FT_Get_Char_Index");
    find(f.load_glyph, "FT_Load_Glyph");
    find(f.kerning, "FT_Get_Kerning");
    find(f.set_charmap, "FT_Set_Charmap");
    find(f.decompose, "FT_Outline_Decompose");
    return f;
  }();
  return functions;
}

// Takes an outline's lines and curves as Bézier segments.
struct Pen {
  Glyph* glyph;
  double scale;
  Point2d at;

  Point2d place(const FT_Vector* v) const {
    return {static_cast<double>(v->x) * scale, static_cast<double>(v->y) * scale};
  }
  void add(Point2d b, Point2d c, Point2d d) {
    glyph->contours.back().insert(glyph->contours.back().end(), {at, b, c, d});
    at = d;
  }
};

Point2d between(Point2d a, Point2d b, double t) { return {a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t}; }

int move_to(const FT_Vector* to, void* user) {
  Pen& pen = *static_cast<Pen*>(user);
  pen.glyph->contours.emplace_back();
  pen.at = pen.place(to);
  return 0;
}
int line_to(const FT_Vector* to, void* user) {
  Pen& pen = *static_cast<Pen*>(user);
  const Point2d a = pen.at, d = pen.place(to);
  pen.add(between(a, d, 1.0 / 3), between(a, d, 2.0 / 3), d);
  return 0;
}
int conic_to(const FT_Vector* control, const FT_Vector* to, void* user) {
  Pen& pen = *static_cast<Pen*>(user);
  const Point2d c = pen.place(control), d = pen.place(to);
  pen.add(between(pen.at, c, 2.0 / 3), between(d, c, 2.0 / 3), d);
  return 0;
}
int cubic_to(const FT_Vector* b, const FT_Vector* c, const FT_Vector* to, void* user) {
  Pen& pen = *static_cast<Pen*>(user);
  pen.add(pen.place(b), pen.place(c), pen.place(to));
  return 0;
}

// Code points; bytes that are no UTF-8 stand for themselves, as Latin-1 has them.
std::vector<FT_ULong> code_points(std::string_view text) {
  std::vector<FT_ULong> points;
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const std::size_t size = byte >= 0xf0 ? 4 : byte >= 0xe0 ? 3 : byte >= 0xc0 ? 2 : 1;
    FT_ULong point = size == 1 ? byte : byte & (0xffu >> (size + 1));
    bool good = i + size <= text.size();
    for (std::size_t k = 1; good && k < size; ++k) {
      const auto next = static_cast<unsigned char>(text[i + k]);
      good = (next & 0xc0) == 0x80;
      point = point << 6 | (next & 0x3f);
    }
    points.push_back(good ? point : byte);
    i += good ? size : 1;
  }
  return points;
}

class Font {
 public:
  explicit Font(const std::string& file) {
    const FreeType& ft = free_type();
    if (ft.init(&library_) != 0) throw Error("FreeType does not start");
    if (ft.new_face(library_, file.c_str(), 0, &face_) != 0 || !FT_IS_SCALABLE(face_)) {
      ft.done(library_);
      throw Error("no font with outlines that FreeType reads", {file});
    }
    if (!face_->charmap && face_->num_charmaps > 0) ft.set_charmap(face_, face_->charmaps[0]);
  }
  Font(const Font&) = delete;
  Font& operator=(const Font&) = delete;
  ~Font() {
    free_type().done_face(face_);
    free_type().done(library_);
  }

  // 0 where it has none. Fonts of symbols have theirs from U+F000 on.
  FT_UInt index(FT_ULong point) const {
    const FT_UInt found = free_type().char_index(face_, point);
    return found || point > 0xff ? found : free_type().char_index(face_, 0xf000 + point);
  }

  Glyph glyph(FT_UInt index) const {
    Glyph made;
    if (free_type().load_glyph(face_, index, FT_LOAD_NO_SCALE | FT_LOAD_NO_BITMAP) != 0) return made;
    made.advance = static_cast<double>(face_->glyph->metrics.horiAdvance) * em();
    if (face_->glyph->format != FT_GLYPH_FORMAT_OUTLINE) return made;
    FT_Outline_Funcs functions{move_to, line_to, conic_to, cubic_to, 0, 0};
    Pen pen{&made, em(), {}};
    const GrantedMemory small;  // an exception cannot pass FreeType
    free_type().decompose(&face_->glyph->outline, &functions, &pen);
    std::erase_if(made.contours, [](const auto& contour) { return contour.size() < 8; });
    return made;
  }

  double kerning(FT_UInt left, FT_UInt right) const {
    FT_Vector by{};
    if (!FT_HAS_KERNING(face_) || free_type().kerning(face_, left, right, FT_KERNING_UNSCALED, &by) != 0)
      return 0;
    return static_cast<double>(by.x) * em();
  }

 private:
  double em() const { return 1.0 / face_->units_per_EM; }

  FT_Library library_ = nullptr;
  FT_Face face_ = nullptr;
};

}  // namespace

std::vector<Glyph> outlines(const std::string& font_file, std::string_view utf8) {
  const Font font(font_file);
  std::vector<Glyph> made;
  FT_UInt before = 0;
  for (const FT_ULong point : code_points(utf8)) {
    const FT_UInt index = font.index(point);
    if (index && before) made.back().advance += font.kerning(before, index);
    made.push_back(index ? font.glyph(index) : Glyph{});
    before = index;
  }
  return made;
}

}  // namespace vitrail::solids
