#!/usr/bin/env python3
"""Pages of the book in target/book: links that leave docs/ go to the files of the tree, and every link and anchor has to be there."""
import html, os, re, sys

BOOK = 'target/book'
LINK = re.compile(r'(href|src)="([^"]+)"')


def pages():
    for folder, _, files in os.walk(BOOK):
        for name in files:
            # Contents and the whole book in one page have the links of all others.
            if name.endswith('.html') and name not in ('print.html', 'toc.html', '404.html'):
                yield os.path.join(folder, name)


def text(path, known={}):
    if path not in known:
        with open(path, encoding='utf8') as file:
            known[path] = file.read()
    return known[path]


def in_tree(page, url):
    """Where a link of a page goes that leaves the book, as the page's source in docs/ has it."""
    path, mark, anchor = url.partition('#')
    source = os.path.join('docs', os.path.relpath(os.path.dirname(page), BOOK))
    for ending in (path, re.sub(r'\.html$', '.md', path)):
        target = os.path.normpath(os.path.join(source, ending))
        if not target.startswith('docs') and os.path.exists(target):
            return os.path.relpath(target, os.path.dirname(page)) + mark + anchor
    return None


def main():
    missing = []
    for page in sorted(pages()):
        def mended(found):
            url = html.unescape(found[2])
            if re.match(r'[a-z]+:|#$', url) or not url:
                return found[0]
            path, _, anchor = url.partition('#')
            target = os.path.normpath(os.path.join(os.path.dirname(page), path)) if path else page
            if not os.path.exists(target) or os.path.relpath(target, BOOK).startswith('..'):
                other = in_tree(page, url)
                if other:
                    return f'{found[1]}="{html.escape(other)}"'
                missing.append(f'{page}: {url}')
            elif anchor and target.endswith('.html') and f'id="{html.escape(anchor)}"' not in text(target):
                missing.append(f'{page}: {url} has no such heading')
            return found[0]
        own = LINK.sub(mended, text(page))
        with open(page, 'w', encoding='utf8') as file:
            file.write(own)
    print('\n'.join(missing) or f'all links of {len(list(pages()))} pages are there')
    sys.exit(bool(missing))


if __name__ == '__main__':
    main()
