/* report_parts.c - pieces of HTML: the head with its style, safe text, badges, and figures inside the page. */
#include "paper/report_parts.h"
#include "paper/svg_small.h"

#include "base/error.h"

#include <ctype.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>

const char fst_report_head[] =
    "<!DOCTYPE html>\n"
    "<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
    "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
    "<title>The counter-rotating bead, computed again</title>\n"
    "<style>\n"
    "body{margin:0;background:#fff;color:#222;font:17px/1.55 Georgia,'DejaVu "
    "Serif',serif;overflow-wrap:break-word}\n"
    "main{max-width:80rem;margin:0 auto;padding:1rem}\n"
    ".cards{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(22rem,100%),1fr));gap:0 "
    "1rem;grid-auto-flow:dense;align-items:start}.cards figure{grid-column:1/-1}\n"
    ".pair{display:flex;flex-wrap:wrap;gap:0 1rem}.pair>div{flex:1 1 20rem;max-width:34rem}\n"
    "@media(min-width:60rem){.single{display:grid;grid-template-columns:34rem 1fr;gap:0 1.5rem}.single "
    "h3{grid-column:1/-1}}\n"
    ".list{columns:3 12rem;font-size:.9rem}\n"
    "h1{font-size:1.8rem;line-height:1.2}h2{margin-top:2.5rem;border-bottom:1px solid #ddd}\n"
    "h3{margin:0 0 .5rem;font-size:1.1rem}h3.group{margin:2.2rem 0 0;font-size:1.25rem}\n"
    "table{border-collapse:collapse;margin:.5rem 0}th,td{padding:.25rem .7rem .25rem "
    "0;text-align:left;vertical-align:top}\n"
    "thead th{border-bottom:1px solid #999}.n{font-variant-numeric:tabular-nums}.n small{white-space:nowrap}\n"
    "small,.fine{color:#595959;font-size:.82rem}.fine{margin:.3rem "
    "0}small.hair{white-space:normal;display:block}\n"
    ".from,.from a{color:#595959;font-size:.85rem;margin:0}\n"
    "pre{background:#f6f6f4;padding:.5rem "
    ".7rem;white-space:pre-wrap;overflow-wrap:anywhere;font-size:.78rem;line-height:1.4;margin:.4rem 0}\n"
    "summary{color:#595959;font-size:.82rem;cursor:pointer}\n"
    "figure{margin:2.2rem 0}figure img{display:block;width:100%;max-width:40rem;height:auto;border:1px solid "
    "#eee}figcaption{margin-top:.4rem}.which{margin:.6rem 0 .1rem;font-size:.85rem;color:#595959}\n"
    ".card{border:1px solid #ddd;border-radius:6px;padding:.7rem 1rem;margin:1rem 0}.card p{margin:.3rem 0}\n"
    ".second{border-left:3px solid #ddd;padding-left:.8rem;margin:.6rem 0}\n"
    ".found li{margin:.7rem 0}\n"
    ".badge{display:inline-block;padding:0 .5rem;border-radius:4px;font:600 .78rem/1.6 "
    "sans-serif;white-space:nowrap}\n"
    ".reproduced{background:#d8efe3;color:#00573a}.close{background:#fdeccb;color:#6d4700}.not{background:#"
    "f9d9cf;color:#7d2600}\n"
    ".facts td.n,.map td.n{padding:.25rem .4rem;border:2px solid #fff}.facts th,.map th{padding:.25rem .4rem}\n"
    ".label{display:none}.tally .n{white-space:nowrap}sub{line-height:0}\n"
    ".map td{font-size:.85rem}\n"
    ".incomplete{background:#fdeccb;padding:.5rem .8rem;border-radius:6px}\n"
    ".rules dt{font-weight:600;margin-top:.5rem}.rules dd{margin:0 0 0 1rem;font-size:.9rem}\n"
    "nav{display:flex;flex-wrap:wrap;gap:.2rem 1rem}a{color:#0064a0}\n"
    "@media(max-width:34rem){main{padding:.8rem}.card{padding:.6rem}\n"
    "table{font-size:.8rem}.tally{font-size:.74rem}th,td{padding-right:.4rem}.narrow .badge,.narrow "
    "small{white-space:normal}\n"
    "figure img{width:calc(100% + 1.6rem);max-width:none;margin-left:-.8rem;border-width:1px 0}\n"
    ".facts thead{display:none}.facts tbody,.facts tr{display:block}\n"
    ".facts tr{display:grid;grid-template-columns:repeat(3,1fr);margin:.9rem 0}.facts "
    "td:first-child{grid-column:1/-1}\n"
    ".facts .label{display:block;font-size:.72rem}}\n"
    /* Words are 46 rem wide; cards and figures take the whole page. */
    "main>:not(.cards):not(figure){max-width:46rem;margin-left:auto;margin-right:auto}main>table{width:100%}\n"
    "</style></head>\n"
    "<body><main>\n";

const char fst_report_introduction[] =
    "<h1>The counter-rotating bead, computed again</h1>\n"
    "<nav><a href=\"#found\">What we found</a><a href=\"#tally\">Count</a><a href=\"#table1\">Table 1</a><a "
    "href=\"#statements\">Claims</a><a href=\"#figures\">Figures</a><a href=\"#dry\">Dry friction</a><a "
    "href=\"#beads\">Several beads</a><a href=\"#waves\">A travelling field</a><a "
    "href=\"#provenance\">Provenance</a></nav>\n"
    "<p>Put a small spherical magnet on a magnetic stirrer and turn it up. Slowly, the bead follows the "
    "magnet round. Faster, it lets go and, of all things, circles <em>the other way</em>, drawing garlands: "
    "festoons. Farago, Charitat, Bigot, Schotter and Kulić measured and explained this in "
    "<em>Counter-rotation of magnetic beads in spinning fields</em> (Phys. Rev. E 102, 042201, 2020; "
    "arXiv:2003.10782). This page repeats what the paper computes and checks what it says. Sections, figures "
    "and equations are counted as in the arXiv's PDF.</p>\n";

const char fst_report_reading[] =
    "<h2 id=\"reading\">How to read this page</h2>\n"
    "<p>Everything is computed twice. <b>farago2020</b> integrates the equations as they are printed; "
    "<b>rigid</b> those of a rigid sphere. They differ by the gyroscopic term alone. A sphere without torque "
    "shows the difference at once: n must circle the fixed angular velocity on a cone, whereas the printed "
    "equation sends it along a great circle. So the first column says whether the paper's computation is "
    "repeated, the second what a bead does. A third, <b>coulomb</b>, rubs dry.</p>\n"
    "<p>Lengths are in ℓ = 23 mm (half the length of the lines that model the magnet), times in 1/γ = 3.2 "
    "ms, so that a drive ω = 0.201 is 10 Hz. A command computes its number again and prints JSON; the text "
    "after the # says how to read the number off that. Put <code>rigid</code> for <code>farago2020</code> to "
    "get the other column, and a drive for <code>OMEGA</code>. Keys <code>eq21_…</code>, <code>eq22_…</code> "
    "and "
    "<code>eq23_…</code> are of the printed Eqs. (12), (13) and (14), by their labels in the paper's "
    "source.</p>\n";

/* Letters that mean something where a text goes, and what is written in their place. */
typedef struct disguise {
    const char *letters, *const *words;
} disguise;
static const disguise in_html = {"<>&\"", (const char *const[]){"&lt;", "&gt;", "&amp;", "&quot;"}};
static const disguise in_address = {"%#\"&\n", (const char *const[]){"%25", "%23", "%22", "&amp;", "%0A"}};

static void put_letter(FILE *out, char c, const disguise *where)
{
    const char *found = strchr(where->letters, c);
    if (found)
        fputs(where->words[found - where->letters], out);
    else
        fputc(c, out);
}

void fst_report_text(FILE *out, const char *text)
{
    for (const char *c = text; *c; ++c)
        put_letter(out, *c, &in_html);
}

/* A byte after the first of a letter in UTF-8. */
static int goes_on(char c)
{
    return ((unsigned char)c & 0xc0) == 0x80;
}

void fst_report_prose(FILE *out, const char *text)
{
    for (const char *c = text; *c; ++c) {
        const int is_letter = (unsigned char)c[1] >= 0x80 || isalpha((unsigned char)c[1]);
        if (*c != '_' || c == text || !(goes_on(c[-1]) || isalpha((unsigned char)c[-1])) || !is_letter) {
            put_letter(out, *c, &in_html);
            continue;
        }
        fputs("<sub>", out);
        if ((unsigned char)c[1] >= 0x80) { /* one letter that is not English */
            do
                fputc(*++c, out);
            while (goes_on(c[1]));
        } else {
            while (isalpha((unsigned char)c[1]))
                fputc(*++c, out);
        }
        fputs("</sub>", out);
    }
}

void fst_report_code(FILE *out, const char *command)
{
    fputs("<pre>", out);
    fst_report_text(out, command);
    fputs("</pre>\n", out);
}

void fst_report_badge(FILE *out, fst_verdict verdict)
{
    static const char *const classes[] = {"reproduced", "close", "not"};
    fprintf(out, "<span class=\"badge %s\">%s</span>", classes[verdict], fst_verdict_name(verdict));
}

/* The whole file as text; free() it, NULL: it cannot be read (errno tells why). */
static char *read_text(const char *path)
{
    FILE *in = fopen(path, "rb");
    char *text = NULL;
    size_t size = 0, room = 0;
    if (!in)
        return NULL;
    for (size_t got = 1; got > 0; size += got) {
        if (size + 1 >= room) {
            char *more = realloc(text, room = 2 * room + 65536);
            if (!more) {
                free(text);
                (void)fclose(in);
                return NULL;
            }
            text = more;
        }
        got = fread(text + size, 1, room - size - 1, in);
    }
    const int failed = ferror(in);
    (void)fclose(in);
    text[size] = '\0';
    if (!failed)
        return text;
    free(text);
    return NULL;
}

/* The SVG as an address that holds it, safe inside double quotes. */
static void write_address(FILE *out, const char *svg)
{
    fputs("data:image/svg+xml,", out);
    for (const char *c = svg; *c; ++c)
        put_letter(out, *c, &in_address);
}

fst_status fst_report_image(FILE *out, const char *path, const char *alternative, fst_error *error)
{
    char *svg = read_text(path);
    if (!svg)
        return fst_fail(error, FST_IO, path, "cannot read the figure again: %s", strerror(errno));
    char *small = fst_svg_small(svg);
    free(svg);
    if (!small)
        return fst_fail(error, FST_NO_MEMORY, path, "no memory for the figure");
    fputs("<img alt=\"", out);
    fst_report_text(out, alternative);
    /* A figure that is an image of its own keeps its names and styles to itself. */
    fputs("\" src=\"", out);
    write_address(out, small);
    fputs("\">\n", out);
    free(small);
    return FST_OK;
}
