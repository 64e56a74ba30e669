#!/usr/bin/env bash
# book.sh FILE.html: the pages of docs/ as one page with a table of contents and all pictures in it, in
# the order of the README's "Read on". `make book` calls it. Needs pandoc.
set -eu
command -v pandoc >/dev/null || { echo "make book needs pandoc (apt-get install pandoc)" >&2; exit 1; }
file=$PWD/$1
mkdir -p "$(dirname "$file")"
version=$(sed -n 's/^.define AMBULO_VERSION_STRING "\(.*\)"/\1/p' include/ambulo/ambulo.h)
pages=$(sed -n '/^## Read on/,$p' README.md | grep -oE '\(docs/[a-z-]*\.md\)' | sed 's/.docs\///; s/)//')
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp -r docs/images "$work/"

# links to what the book has not (README, sources, models) keep their text, in code; pictures that a
# page only links to are shown
for page in $pages; do
  sed -E '/^ *```/,/^ *```/!{
    s/\[`?([^]`]*)`?\]\((\.\.|examples)\/[^)]*\)/`\1`/g
    s/(^|[^!])(\[[^]]*\]\(images\/)/\1!\2/g
  }' "docs/$page" >"$work/$page"
done
# each page by itself, so that a heading of page.md is #page.md__heading and the page #page.md
for page in $pages; do
  echo "<section id=\"$page\">"
  (cd "$work" && pandoc --from gfm --to html5 --wrap=none --self-contained --metadata title="$page" \
    --id-prefix="${page}__" "$page") | sed '1,/<\/header>/d; /^<\/body>/,$d'
  echo '</section>'
done | sed -E 's/href="([a-z-]+\.md)#/href="#\1__/g; s/href="([a-z-]+\.md)"/href="#\1"/g' >"$work/body"

{
  cat <<END
<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Ambulo $version</title>
<style>
body { max-width: 52em; margin: auto; padding: 1em 1.5em; font: 1rem/1.5 sans-serif; color: #222; }
table { border-collapse: collapse; display: block; overflow-x: auto; font-size: .9em; }
th, td { border-top: 1px solid #ccc; padding: .2em .6em; text-align: left; vertical-align: top; }
pre, code { font-family: monospace; background: #f5f5f5; }
pre { padding: .6em; overflow-x: auto; }
section > h1 { border-top: 3px solid #888; padding-top: .6em; margin-top: 3em; }
nav ul { list-style: none; padding-left: 0; } nav ul.inner { padding-left: 2em; font-size: .9em; }
img { max-width: 100%; }
#search { width: 100%; font: inherit; padding: .3em .5em; box-sizing: border-box; }
#found { list-style: none; padding-left: 0; } #found li { margin: .5em 0; font-size: .9em; }
</style>
</head>
<body>
<h1>Ambulo $version</h1>
<input id="search" type="search" placeholder="Search all pages" aria-label="Search all pages">
<ol id="found"></ol>
<nav><ul>
END
  # headings of the first two levels, each on a line of its own
  sed -nE 's/^<h([12]) id="([^"]*)">(.*)<\/h[12]>$/\1 \2 \3/p' "$work/body" | awk '
    { level = $1; id = $2; sub(/^[^ ]* [^ ]* /, "") }
    level == 1 { if (open) print "</ul></li>"; printf "<li><a href=\"#%s\">%s</a>\n<ul class=\"inner\">\n", id, $0; open = 1 }
    level == 2 { printf "<li><a href=\"#%s\">%s</a></li>\n", id, $0 }
    END { if (open) print "</ul></li>" }'
  echo '</ul></nav>'
  cat "$work/body"
  cat <<'END'
<script>
// every paragraph, item, row and block of code, under the heading it belongs to
const places = [];
let heading = null;
for (const node of document.querySelectorAll('section h1, section h2, section h3, section p, section li, section tr, section pre')) {
  if (/^H[123]$/.test(node.tagName)) heading = node;
  places.push({node, heading, text: node.textContent.replace(/\s+/g, ' ')});
}
const box = document.getElementById('search');
const found = document.getElementById('found');
const most = 40;
function search() {
  const words = box.value.toLowerCase().split(/\s+/).filter((word) => word.length > 1);
  const hits = !words.length ? [] : places.filter((place) => {
    const text = ((place.heading ? place.heading.textContent + ' ' : '') + place.text).toLowerCase();
    return words.every((word) => text.includes(word)) && words.some((word) => place.text.toLowerCase().includes(word));
  });
  found.replaceChildren(...hits.slice(0, most).map((hit, i) => {
    const item = document.createElement('li');
    const link = document.createElement('a');
    if (!hit.node.id) hit.node.id = 'place-' + places.indexOf(hit);
    link.href = '#' + hit.node.id;
    link.textContent = hit.heading ? hit.heading.textContent : 'Ambulo';
    const at = Math.max(0, hit.text.toLowerCase().indexOf(words.find((word) => hit.text.toLowerCase().includes(word))) - 60);
    item.append(link, ': ' + hit.text.slice(at, at + 200));
    return item;
  }));
  if (words.length && !hits.length) found.textContent = 'Nothing found.';
  if (hits.length > most) found.append(`and ${hits.length - most} more`);
}
box.addEventListener('input', search);
</script>
END
  echo '</body></html>'
} >"$work/book.html"
mv "$work/book.html" "$file"
echo "written to $1"
