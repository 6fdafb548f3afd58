# Headers as Doxygen reads them. A comment above a declaration documents it and those below, up to an empty
# line; a comment behind a declaration documents that alone. Copies, destructors and comparisons that every
# value has are left out.
function is_comment(line) { return line ~ /^ *\/\// }
function is_common(line) {
  return line ~ /operator(==|<=>)\(.*(default|const);/ || line ~ /operator==\(.*{ return true; }/ || line ~ /operator=\(/ || line ~ /^ *(virtual )?~/ ||
         line ~ /^ *[A-Z][A-Za-z0-9]*\((const [A-Z][A-Za-z0-9]*&|[A-Z][A-Za-z0-9]*&&)?\)( noexcept)?( = [a-z]+)?;/
}
{
  line = $0
  if (is_common(line)) { print ""; next }
  if (is_comment(line)) {
    if (!is_comment(last)) { block = ""; if (last ~ /  \/\/ /) print "" }
    sub(/\/\/ ?/, "/// ", line)
    block = block line "\n"
  } else if (line ~ /^ *$/ || line ~ /^ *(private:|public:|#|namespace)/ || line ~ /^(class|struct) .*{$/) {
    block = ""
  } else if (!is_comment(last) && last ~ /[;}]( *\/\/.*)?$/ && line !~ /^ *}/ && block != "") {
    printf "%s", block
  }
  if (!is_comment($0)) sub(/  \/\/ /, "  ///< ", line)
  print line
  last = $0
}
