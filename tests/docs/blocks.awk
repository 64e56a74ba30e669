# Takes the blocks of code out of a page: one file each, OUT/NNN.KIND, and a line
# "NNN.KIND <tab> PAGE:LINE" on standard output. KIND is the language of a fenced block, "indented"
# for a block indented by four columns after an empty line, or "help" for the lines of an example
# in the --help of a command (HELP=1, where LINE counts its lines).
function begin(kind) {
  file = sprintf("%03d.%s", ++count, kind == "" ? "plain" : kind)
  printf "%s\t%s:%d\n", file, PAGE, FNR
  file = OUT "/" file
}
function end() { if (file != "") close(file); file = "" }
function fence_of(text) { sub(/^ */, "", text); return text ~ /^```/ }
HELP {
  if (/^examples?:/) { begin("help"); next }
  if (file != "" && !/^  /) end()
  if (file != "") print substr($0, 3) > file
  next
}
fence_of($0) {
  if (fenced) { end(); fenced = 0 }
  else { end(); fenced = 1; sub(/^ *```/, ""); begin($0) }
  blank = 0
  next
}
fenced { print > file; next }
/^    / && (blank || file != "") {
  if (file == "") begin("indented")
  while (gaps-- > 0) print "" > file
  gaps = 0
  print substr($0, 5) > file
  next
}
/^ *$/ { blank = 1; if (file != "") gaps++; next }
{ end(); blank = gaps = 0 }
END { end() }
