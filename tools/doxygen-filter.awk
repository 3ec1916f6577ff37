# Turn the public headers' plain comments into Doxygen's, on the way to the API reference:
#   the first comment of a file       documents the file,
#   a comment that starts its line    documents what follows,
#   a comment behind code             documents what stands before it;
# and rulers between sections are left out.  Where a struct takes its fields from a .def table, the rows are written
# out as fields with their docs.  Within comments, signs that Doxygen would read as markup are made plain.

function plain(text)
{
    gsub(/&/, "\\&amp;", text)
    gsub(/</, "\\&lt;", text)
    gsub(/>/, "\\&gt;", text)
    gsub(/[\\@#%]/, "\\\\&", text)
    gsub(/'/, "\\&apos;", text)
    gsub(/"/, "\\&quot;", text)
    return text
}

# From a place inside a comment: its text goes out plain, up to its end.
function inside(text,    end)
{
    end = index(text, "*/")
    if (end == 0) {
        in_comment = 1
        return plain(text)
    }
    in_comment = 0
    return plain(substr(text, 1, end - 1)) substr(text, end)
}

# The rows of a table of physics.def, ROW(NAME, name, ..., "doc"), as "name: doc; name: doc.".
function rows_of(table,    line, here, text, docs, names, strings)
{
    while ((getline line < (folder "physics.def")) > 0) {
        if (line ~ /^#define/)
            here = index(line, "#define " table "(ROW)") == 1
        if (!here || line !~ /ROW\(|"/)
            continue
        text = text line
        if (line !~ /"\)/)
            continue
        split(text, strings, "\"")
        sub(/.*ROW\(/, "", strings[1])
        split(strings[1], names, /[(, ]+/)
        docs = docs (docs == "" ? "" : "; ") names[2] ": " strings[2]
        text = ""
    }
    close(folder "physics.def")
    return docs "."
}

# The rows of a table of lists.def, ROW(NAME, "name", "doc", ...): NAME, name and doc of each in list_name[], list_word[]
# and list_doc[], behind the `count` that are there; returns how many there are then.
function list_of(table, count,    all, line, here, rows, i, strings, names)
{
    while ((getline line < (folder "lists.def")) > 0) {
        if (line ~ /^#define/)
            here = index(line, "#define " table "(ROW)") == 1
        if (here) {
            sub(/ *\\$/, "", line)
            all = all line
        }
    }
    close(folder "lists.def")
    rows = split(all, names, /ROW\(/)
    for (i = 2; i <= rows; ++i) {
        gsub(/"  *"/, "", names[i])
        if (names[i] ~ /^ROW\)/ || split(names[i], strings, "\"") < 3)
            continue
        ++count
        list_name[count] = names[i]
        sub(/,.*/, "", list_name[count])
        list_word[count] = strings[2]
        list_doc[count] = strings[4]
    }
    return count
}

# The docs of a choice whose rows are in lists.def, as "name: doc; name: doc.".
function docs_of(table,    count, i, docs)
{
    count = list_of(table, 0)
    for (i = 1; i <= count; ++i)
        docs = docs (i > 1 ? "; " : "") list_word[i] ": " list_doc[i]
    return docs "."
}

# typedef enum { FST_LIST(FST_ROW_ENUM) COUNT } name; with an enumerator for each row; FST_ROW_FLAG is its flag.
function put_enum(line,    words, count, i)
{
    split(line, words, /[ ({}]+/)
    count = list_of("FST_FOLLOWED_SPECIALS", 0)
    count = list_of(words[3], words[3] == "FST_SPECIALS" ? count : 0)
    print "typedef enum {"
    for (i = 1; i <= count; ++i)
        print "FST_" list_name[i] ", /**< " plain("\"" list_word[i] "\": " list_doc[i]) " */"
    sub(/.*FST_ROW_(ENUM|FLAG)\) /, "", line)
    print line
}

# One row of a .def table, FST_KIND(group, name, ... "doc") or FST_RESULT(name, "unit", "doc"), as a field.
function put_field(row,    words, strings, count, kind, name, i, doc)
{
    count = split(row, strings, "\"")
    split(strings[1], words, /[(, ]+/)
    kind = words[1]
    name = kind == "FST_RESULT" ? words[2] : words[2] "_" words[3]
    # Odd pieces lie between the strings; the first string of these two kinds is not the doc.
    for (i = kind == "FST_RESULT" || kind == "FST_CHOICE" ? 4 : 2; i <= count; i += 2)
        doc = doc strings[i]
    if (kind == "FST_RESULT")
        doc = doc " [" strings[2] "]"
    if (row ~ /FST_SOURCE_DOCS/)
        doc = rows_of("FST_SOURCES")
    if (row ~ /FST_CONTACT_DOCS/)
        doc = rows_of("FST_CONTACTS")
    if (row ~ /FST_DOCS\(/) {
        sub(/.*FST_DOCS\(/, "", row)
        sub(/\).*/, "", row)
        doc = docs_of(row)
    }
    if (kind == "FST_TEXT")
        print "char " name "[" words[4] "]; /**< " plain(doc) " */"
    else
        print (kind == "FST_REAL" || kind == "FST_RESULT" ? "double " : "int ") name "; /**< " plain(doc) " */"
}

function put_table(file,    line, row)
{
    while ((getline line < file) > 0) {
        if (line ~ /^FST_[A-Z]+\(/)
            row = line
        else if (row != "")
            row = row line
        if (row != "" && line ~ /("|_DOCS|FST_DOCS\(FST_[A-Z_]+\))\)$/) {
            put_field(row)
            row = ""
        }
    }
    close(file)
}

in_comment { print inside($0); next }

FNR == 1 {
    folder = FILENAME
    sub(/[^\/]*$/, "", folder)
}

/FST_ROW_(ENUM|FLAG)\) / { put_enum($0); next }

/FST_ROW_PLACE\)/ { next } # only what the flags are made of

/^#include <festoon\/(params|run)\.def>/ {
    match($0, /\/.*\.def/)
    put_table(folder substr($0, RSTART + 1, RLENGTH - 1))
    next
}

/^\/\* -----/ { print ""; next }

/\/\*/ {
    start = index($0, "/*")
    code = substr($0, 1, start - 1)
    if (!seen_comment++)
        mark = "/** @file\n *"
    else if (code ~ /^[ \t]*$/)
        mark = "/**"
    else
        mark = "/**<"
    print code mark inside(substr($0, start + 2))
    next
}

{ print }
