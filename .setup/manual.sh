#!/usr/bin/env bash
# manual.sh PROGRAM FOLDER: the manual and the completions of shells, below FOLDER as `make install`
# has them below share/: man/man1 (made by the program from the tables of --help), man/man5 (the
# pages of docs/), bash-completion, zsh, fish. Needs awk.
set -eu
program=$1 folder=$2
rm -rf "$folder"
mkdir -p "$folder/man/man1" "$folder/man/man5" "$folder/bash-completion/completions" \
  "$folder/zsh/site-functions" "$folder/fish/vendor_completions.d"

"$program" help --man >"$folder/man/man1/ambulo.1"
for command in $("$program" --help | sed -n '/^commands:/,/^$/s/^  \([a-z]*\) .*/\1/p'); do
  "$program" help --man "$command" >"$folder/man/man1/ambulo-$command.1"
done

title=$(sed -n 1p "$folder/man/man1/ambulo.1") # .TH AMBULO 1 DATE "ambulo VERSION" Ambulo
date=$(echo "$title" | awk '{ print $4 }') version=$(echo "$title" | sed 's/.*"ambulo \(.*\)".*/\1/')
page() { # NAME ABOUT PAGE
  awk -f .setup/man_page.awk -v name="ambulo-$1" -v section=5 -v date="$date" -v about="$2" \
    -v version="$version" "docs/$3.md" >"$folder/man/man5/ambulo-$1.5"
}
page problem 'problem files: what a motion has to do' problem-format
page model 'model files: skeletons' model-format
page muscles 'muscles files: muscles on the joints of a skeleton' muscles-format
page batch 'sweep files, and the folders of batches' batch-format
page results 'what is written into a result folder' results

"$program" help --completion bash >"$folder/bash-completion/completions/ambulo"
"$program" help --completion zsh >"$folder/zsh/site-functions/_ambulo"
"$program" help --completion fish >"$folder/fish/vendor_completions.d/ambulo.fish"
