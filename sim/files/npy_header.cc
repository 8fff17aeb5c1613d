#include "sim/files/npy_header.h"
#include "sim/base/joined.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <stdexcept>
#include <utility>

namespace dodgesim {

namespace {

constexpr std::string_view kNpyMagic = "\x93NUMPY";
constexpr std::size_t kAlignment = 64;  // of the array in the file, as NumPy does it

// NumPy's own spelling: "<u1" and "u1" are "|u1", "=f4" and "f4" are "<f4". Single bytes have no
// byte order, and the native one is little-endian here.
std::string plain_dtype(std::string text) {
  if (text.empty()) return text;
  const bool has_order = std::string_view("<>=|").find(text.front()) != std::string_view::npos;
  const std::string kind = text.substr(has_order ? 1 : 0);
  const bool bytes = kind == "u1" || kind == "i1" || kind == "b1";
  if (bytes) return "|" + kind;
  if (!has_order || text.front() == '=') return "<" + kind;
  return text;
}

// The few forms of Python's literals that NumPy writes.
class HeaderParser {
 public:
  explicit HeaderParser(std::string_view text) : rest_(text) {}

  NpyHeader parse() {
    expect('{');
    while (!accept('}')) {
      const std::string key = quoted_text();
      expect(':');
      read_value(key);
      if (accept(',')) continue;
      expect('}');
      break;
    }
    skip_space();
    if (!rest_.empty()) fail("something follows the dictionary");
    for (const auto& [given, name] :
         {std::pair{dtype_.has_value(), "descr"}, std::pair{order_.has_value(), "fortran_order"},
          std::pair{shape_.has_value(), "shape"}}) {
      if (!given) fail(std::string("the key ") + name + " is missing");
    }
    return {*dtype_, *order_, *shape_};
  }

 private:
  [[noreturn]] static void fail(const std::string& what) { throw std::invalid_argument(what); }

  void read_value(const std::string& key) {
    if (key == "descr") {
      once(dtype_, key, peek() == '[' ? list_text() : quoted_text());
      if (!dtype_->starts_with('[')) dtype_ = plain_dtype(*dtype_);
      if (std::any_of(dtype_->begin(), dtype_->end(), is_control)) fail("descr is no data type");
    } else if (key == "fortran_order") {
      once(order_, key, truth());
    } else if (key == "shape") {
      once(shape_, key, tuple());
    } else {
      fail("the key \"" + key + "\" is unknown");
    }
  }

  template <class T>
  static void once(std::optional<T>& slot, const std::string& key, T value) {
    if (slot) fail("the key " + key + " is given twice");
    slot = std::move(value);
  }

  static bool is_control(char c) { return (c >= 0 && c < ' ') || c == 0x7f; }

  void skip_space() {
    const std::size_t n = rest_.find_first_not_of(" \t\r\n");
    rest_.remove_prefix(n == std::string_view::npos ? rest_.size() : n);
  }

  char peek() {
    skip_space();
    if (rest_.empty()) fail("it ends too early");
    return rest_.front();
  }

  bool accept(char c) {
    if (peek() != c) return false;
    rest_.remove_prefix(1);
    return true;
  }

  void expect(char c) {
    if (!accept(c)) fail(std::string("\"") + c + "\" is missing");
  }

  std::string quoted_text() {
    const char quote = peek();
    if (quote != '\'' && quote != '"') fail("a text in quotes is missing");
    const std::size_t end = rest_.find(quote, 1);
    if (end == std::string_view::npos) fail("a text does not end");
    std::string text(rest_.substr(1, end - 1));
    rest_.remove_prefix(end + 1);
    return text;
  }

  std::string list_text() {
    int depth = 0;
    for (std::size_t i = 0; i < rest_.size(); ++i) {
      if (rest_[i] == '[') ++depth;
      if (rest_[i] != ']' || --depth > 0) continue;
      std::string text(rest_.substr(0, i + 1));
      rest_.remove_prefix(i + 1);
      return text;
    }
    fail("a list does not end");
  }

  bool truth() {
    skip_space();
    for (const auto& [word, value] : {std::pair{"True", true}, std::pair{"False", false}}) {
      if (!rest_.starts_with(word)) continue;
      rest_.remove_prefix(std::string_view(word).size());
      return value;
    }
    fail("fortran_order is neither True nor False");
  }

  std::vector<std::uint64_t> tuple() {
    std::vector<std::uint64_t> numbers;
    expect('(');
    while (!accept(')')) {
      skip_space();
      std::uint64_t number = 0;
      const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), number);
      if (error != std::errc()) fail("shape is not a tuple of sizes");
      rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
      if (rest_.starts_with('L')) rest_.remove_prefix(1);  // Python 2
      numbers.push_back(number);
      if (accept(',')) continue;
      expect(')');
      break;
    }
    return numbers;
  }

  std::string_view rest_;
  std::optional<std::string> dtype_;
  std::optional<bool> order_;
  std::optional<std::vector<std::uint64_t>> shape_;
};

}  // namespace

NpyHeader parse_npy_header(std::string_view text) { return HeaderParser(text).parse(); }

std::string shape_text(const std::vector<std::uint64_t>& shape) {
  return "(" + joined(shape, [](std::uint64_t side) { return std::to_string(side); }) +
         (shape.size() == 1 ? ",)" : ")");
}

std::string npy_front(const std::string& descr, const std::vector<std::uint64_t>& shape,
                      std::size_t min_bytes) {
  std::string header =
      "{'descr': " + descr + ", 'fortran_order': False, 'shape': " + shape_text(shape) + ", }";
  const std::size_t start = kNpyMagic.size() + 4;  // version and length
  const std::size_t bytes = std::max(start + header.size() + 1, min_bytes);
  const std::size_t length = (bytes + kAlignment - 1) / kAlignment * kAlignment - start;
  if (length > 0xffff) throw std::invalid_argument("The header is too long for version 1.0.");
  header.append(length - 1 - header.size(), ' ');
  std::string front(kNpyMagic);
  front += {'\x01', '\x00', static_cast<char>(length & 0xff), static_cast<char>(length >> 8)};
  return front + header + "\n";
}

}  // namespace dodgesim
