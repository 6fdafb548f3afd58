// SPDX-License-Identifier: Apache-2.0
// A Reader reads POV-Ray's scene language in one pass: tokens with directives carried out and macros put in
// place, and the expressions above them. Functions that read objects and textures take a Reader.
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "importers/bytes/included_text.h"
#include "importers/bytes/input_bytes.h"
#include "importers/povray/read/lexer.h"
#include "importers/povray/read/notes.h"
#include "importers/povray/read/number_words.h"
#include "importers/povray/read/search.h"
#include "importers/reading/import_options.h"
#include "scene/geometry/vec.h"
#include "scene/records/pattern_texture.h"

namespace vitrail::pov {

// They limit what a scene may ask for before it is refused.
struct Limits : ProgramLimits {
  std::uint64_t include_bytes = 1 << 30;  // of text that is included again
};

struct Macro {
  std::string name;
  std::vector<Symbol*> parameters;
  std::shared_ptr<const TokenBuffer> buffer;
  std::size_t begin = 0, end = 0;
};

// Returns whether an element of the array, or of one within it, is of kind T.
template <class T>
bool holds(const Array& array) {
  for (const Value& element : array.elements) {
    if (std::holds_alternative<T>(element)) return true;
    const auto* inner = std::get_if<std::shared_ptr<Array>>(&element);
    if (inner && holds<T>(**inner)) return true;
  }
  return false;
}

// They hold what `#default` says of objects to come.
struct Defaults {
  Shared<Texture> texture;
};

class Reader {
 public:
  Reader(const std::filesystem::path& file, const Search& search, const Limits& limits);
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  // ---- Tokens. Directives are carried out on the way.
  Token next();
  Token peek();
  void put_back(const Token& token) { put_back_.push_back(token); }
  bool accept(char sign);
  bool accept(Word word);
  // Reads the sign. Throws Error where something else comes next.
  void expect(char sign, const char* where);
  // They return whether the sign or word comes next. Directives that set something stay where they are: what
  // is before them may not be complete.
  bool at(char sign) { return peek_operator().is(sign); }
  bool at(Word word) { return peek_operator().is(word); }
  // Skips a comma, if there is one.
  void comma() {
    if (at(',')) next();
  }
  // Counts how deep objects and expressions lie within each other; throws Error above the limit.
  class Deeper;

  // ---- Errors, with the macros and files that lead there.
  [[noreturn]] void fail(const std::string& message, const Place& place);
  // Throws Error: objects, textures or brackets lie too deep within each other.
  [[noreturn]] void too_deep(const Place& place);
  // Throws Error: things are declared of each other to more levels than `most` (levels.h).
  [[noreturn]] void too_many_levels(int most);
  int function_levels = 0;  // the most of a function that was read for the object that is
  [[noreturn]] void unexpected(const Token& token, const std::string& wanted);
  SourceLocation location(const Place& place) const;
  // Returns the place of the token that was read last.
  Place here() const { return last_; }

  // ---- Expressions (expressions.cpp).
  // Reads any value that an identifier, an array's element or an expression gives.
  Value evaluate();
  // Reads numbers: comparisons only where a bracket is around, as "0 <1,2,3>" are a number and a vector.
  Numbers numbers();
  // Reads a number without operators behind it.
  double operand() { return primary().v[0]; }
  double number(const char* what);
  int integer(const char* what);
  bool flag();  // "on", "off", 1, or nothing, which is on
  // Reads a vector of three terms.
  Vector3d vector(const char* what);
  Point3d point(const char* what);
  Point2d point2(const char* what);
  std::string text(const char* what);
  // Reads linear red, green, blue, filter, transmit.
  Numbers color();
  // Returns whether what comes can begin an expression of numbers.
  bool number_follows();

  // ---- Identifiers.
  Symbols& symbols() { return symbols_; }
  // Returns a value of kind T if the next word stands for one; it is read then.
  template <class T>
  std::optional<T> identifier() {
    const Token token = next();
    if (token.kind == TokenKind::word && token.symbol->word == Word::none)
      if (Value* value = token.symbol->value()) {
        if (const T* held = std::get_if<T>(value)) return *held;
        if (const auto* array = std::get_if<std::shared_ptr<Array>>(value); array && holds<T>(**array)) {
          Value element = postfixed(token);
          if (const T* held = std::get_if<T>(&element)) return std::move(*held);
          fail(std::string("this is ") + kind_of(element), token.place);
        }
      }
    put_back(token);
    return std::nullopt;
  }

  // ---- What the scene sets.
  Defaults defaults;
  void set_defaults();  // by the block of #default
  Notes notes;
  // It is 0 where the file does not say. POV-Ray then computes as before 3.7, but the word `version` gives
  // 3.7: what an include saves by it and restores at its end counts as said.
  double version = 0;
  // It is the generator of patterns that have none of their own: global_settings say it, else the version
  // where the scene ends.
  std::shared_ptr<NoiseGenerator> noise = std::make_shared<NoiseGenerator>(NoiseGenerator::corrected);
  bool has_noise = false;               // global_settings say
  std::optional<double> assumed_gamma;  // srgb_gamma: sRGB's curve
  bool for_export = false;              // ImportOptions::for_export
  bool has_uv_mapping = false;          // somewhere in the scene
  int image_width = 640, image_height = 480;
  // They say whether an object is a target of photons, and whether a lamp or an object lets them bend or
  // mirror: povray shoots none without both.
  bool has_photon_target = false, photons_go_on = false;
  double clock = 0;  // the time of an animation
  // Sets what stands before the scene, as POV-Ray's Declare=NAME=VALUE: a number, or text where it is none.
  // `clock` sets that. Throws UsageError where a scene cannot have such a name.
  void define(const std::string& name, const std::string& value);

  // Returns the exponent that makes light of the numbers of pictures; none: they are encoded as sRGB.
  std::optional<double> gamma() const;
  // Returns whether it is before 3.7, without assumed_gamma: such scenes convert nothing.
  bool has_no_gamma() const { return !assumed_gamma && version < 3.7; }
  // Takes a number ≥ 0 of a colour, factor or light: as it is, for a film of this gamma; for export as light.
  double linear(double value) const;

  // Finds a file of the scene, written by it or found by the search; throws Error at `place`, with the hint.
  std::filesystem::path find_file(const std::string& name, const Place& place, const char* hint = "");
  // Finds an image so; returns "", with a note, where it is missing and grey 0.5 may stand for it.
  std::string find_image(const std::string& name, const Place& place);
  bool replace_missing = false;
  const std::deque<std::string>& files() const { return files_; }
  std::uint64_t tokens_read() const { return tokens_; }

 private:
  // It is a block of #if or #switch.
  struct Block {
    bool is_switch = false;
    double value = 0;
    Place place;
    std::uint32_t match = 0;
  };
  enum class FrameKind { file, macro, while_loop, for_loop };
  struct Source {
    Source(const std::filesystem::path& path, Symbols& symbols, std::deque<std::string>& texts,
           std::uint16_t file);
    Source(std::string content, Symbols& symbols, std::deque<std::string>& texts, std::uint16_t file);
    std::string content;
    std::optional<InputBytes> bytes;
    Lexer lexer;
  };
  struct Frame {
    FrameKind kind = FrameKind::file;
    Place call;
    std::unique_ptr<Source> source;  // of a file
    std::shared_ptr<const TokenBuffer> buffer;
    std::size_t begin = 0, at = 0, end = 0;
    std::string name;
    std::vector<Block> blocks;
    std::shared_ptr<Value> variable;  // of #for
    double last = 0, step = 0;
    bool is_asking = false;  // of #while: its condition is read again
  };

  // These read sources (sources.cpp).
  void guard_stack();
  Token raw();
  bool end_frame();
  void open_file(const std::filesystem::path& path, const std::string& name, const Place& place);
  void push(Frame frame);
  void pop_frame();
  std::uint16_t file_index(const std::string& name);
  std::string excerpt(const Place& place) const;

  // These carry out directives (directives.cpp).
  void execute(const Token& directive);
  void include(const Token& directive);
  void define_macro(const Token& directive);
  void invoke(const Token& name, const Shared<Macro>& macro);
  void open_while(const Token& directive);
  void open_for(const Token& directive);
  void open_if(const Token& directive);
  void open_switch(const Token& directive);
  void part(const Token& directive);
  void break_out(const Token& directive);
  void declare(bool local);
  void undefine();
  void set_version(const Place& place);
  void open_text_file(const Token& directive);
  void close_text_file();
  void write_text();
  void read_text();
  std::string message_text();
  bool condition();
  bool test_defined();
  Symbol* raw_name(const char* what);
  // It has the tokens up to the #end of a block, whose directive was just read.
  struct Body {
    std::shared_ptr<const TokenBuffer> buffer;
    std::size_t begin, end;
  };
  Body body(const Token& directive);
  // Goes to the directive that parts or ends the block at the same level, and reads it.
  Token skip_part(std::uint32_t match, const Place& opened);
  void choose(const Block& block, Token part, bool taken);
  Frame& frame() { return frames_.back(); }
  void count_token();

  // These read expressions.
  Numbers conditional();
  Numbers disjunction();
  Numbers conjunction();
  Numbers relation();
  std::optional<Numbers> relation_of_texts();
  Numbers sum();
  Numbers product();
  Numbers unary();
  Numbers primary();
  Numbers color_of_terms(Word word);
  Numbers bracketed_vector();
  Numbers with_component(Numbers n);
  std::optional<Numbers> constant_of(Word word);
  std::optional<Numbers> function_of(const Token& word);
  std::optional<Numbers> query_of(const Token& word);
  Numbers inside_of(const Object& object);
  Numbers traced(const Object& object);
  std::optional<std::string> text_function(Word word);
  double defined_value();
  double argument(bool first = false);
  Numbers vector_argument(bool first = false);
  Token peek_operator();
  // Returns the value of an identifier with what follows it: [index], (arguments).
  Value postfixed(const Token& name);
  Value* variable_of(const Token& name);
  Value call(const Value& callee, const Token& name);

  Symbols symbols_;
  std::deque<std::string> texts_, files_;
  Search search_;
  Limits limits_;
  IncludedText included_;
  std::vector<Frame> frames_;
  std::vector<Token> put_back_;
  Place last_;
  bool declaring_ = true;         // directives that set something are carried out
  bool expanding_ = true;         // macros are put in place
  bool comparing_ = false;        // < and > compare
  std::optional<Numbers> first_;  // an operand that has been read already
  std::uint64_t tokens_ = 0, written_ = 0;
  int depth_ = 0;
  const std::uintptr_t stack_begin_, stack_bytes_;
  std::vector<std::uint32_t> random_;  // states of rand()'s streams
  std::map<std::string, std::string> written_files_;
};

class Reader::Deeper {
 public:
  Deeper(Reader& reader, const Place& place) : reader_(reader) {
    if (++reader_.depth_ > reader_.limits_.nested) {
      --reader_.depth_;
      reader_.too_deep(place);
    }
  }
  ~Deeper() { --reader_.depth_; }
  Deeper(const Deeper&) = delete;
  Deeper& operator=(const Deeper&) = delete;

 private:
  Reader& reader_;
};

// Reads a value of any kind, as #declare and arguments take it (values.cpp).
Value read_value(Reader& reader);

}  // namespace vitrail::pov
