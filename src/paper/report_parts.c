/* report_parts.c - pieces of HTML: the head with its style, safe text, badges, and figures inside the page. */
#include "paper/report_parts.h"

#include "base/error.h"

#include <errno.h>
#include <string.h>

const char fst_report_head[] =
    "<!DOCTYPE html>\n"
    "<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
    "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
    "<title>The counter-rotating bead, computed again</title>\n"
    "<style>\n"
    "body{margin:0;background:#fff;color:#222;font:17px/1.55 Georgia,'DejaVu Serif',serif}\n"
    "main{max-width:46rem;margin:0 auto;padding:1rem}\n"
    "h1{font-size:1.8rem;line-height:1.2}h2{margin-top:2.5rem;border-bottom:1px solid #ddd}\n"
    "h3{margin:0 0 .5rem;font-size:1.1rem}h3 small{font-weight:normal;color:#666}\n"
    "table{border-collapse:collapse;margin:.5rem 0}th,td{padding:.25rem .7rem .25rem "
    "0;text-align:left;vertical-align:top}\n"
    "thead th{border-bottom:1px solid #999}.n{font-variant-numeric:tabular-nums;white-space:nowrap}\n"
    "small,.fine{color:#666;font-size:.82rem}.fine{margin:.3rem 0}.scroll{overflow-x:auto}\n"
    ".from{color:#666;font-size:.85rem;margin:0}\n"
    "pre{background:#f6f6f4;padding:.5rem "
    ".7rem;white-space:pre-wrap;overflow-wrap:anywhere;font-size:.78rem;line-height:1.4;margin:.4rem 0}\n"
    "figure{margin:2rem 0}figure img{width:100%;height:auto;border:1px solid "
    "#eee}figcaption{margin-top:.4rem}\n"
    ".card{border:1px solid #ddd;border-radius:6px;padding:.7rem 1rem;margin:1rem 0}.card p{margin:.3rem 0}\n"
    ".badge{display:inline-block;padding:0 .5rem;border-radius:4px;font:600 .78rem/1.6 "
    "sans-serif;white-space:nowrap}\n"
    ".reproduced{background:#d8efe3;color:#00573a}.close{background:#fdeccb;color:#6d4700}.not{background:#"
    "f9d9cf;color:#7d2600}\n"
    ".incomplete{background:#fdeccb;padding:.5rem .8rem;border-radius:6px}\n"
    ".rules dt{font-weight:600;margin-top:.5rem}.rules dd{margin:0 0 0 1rem;font-size:.9rem}\n"
    "nav{display:flex;flex-wrap:wrap;gap:.2rem 1rem}a{color:#0064a0}\n"
    "@media(max-width:30rem){.scroll table,.card "
    "table{font-size:.82rem}th,td{padding-right:.45rem}.card{padding:.6rem}}\n"
    "</style></head>\n"
    "<body><main>\n";

const char fst_report_introduction[] =
    "<h1>The counter-rotating bead, computed again</h1>\n"
    "<nav><a href=\"#table1\">Table 1</a><a href=\"#figures\">Figures</a><a "
    "href=\"#dry\">Dry friction</a><a href=\"#statements\">Statements</a><a "
    "href=\"#provenance\">Provenance</a></nav>\n"
    "<p>Put a small spherical magnet on a magnetic stirrer and turn it up. Slowly, the bead follows the "
    "magnet round. Faster, it lets go and, of all things, circles <em>the other way</em>, drawing garlands: "
    "festoons. Farago, Charitat, Bigot, Schotter and Kulić measured and explained this in "
    "<em>Counter-rotation of magnetic beads in spinning fields</em> (Phys. Rev. E 102, 042201, 2020; "
    "arXiv:2003.10782). This page repeats what the paper computes and checks what it says.</p>\n"
    "<p>Everything is computed twice. <b>farago2020</b> integrates the equations as they are printed; "
    "<b>rigid</b> those of a rigid sphere. They differ by one term: the spin ψ′ about the magnetic axis acts "
    "back on the axis, as in a gyroscope, by ψ′ n × n′, and the printed equation for n lacks it. A sphere "
    "without torque shows the difference at once: n must circle the fixed angular velocity on a cone, "
    "whereas the printed equation sends it along a great circle. So the first column says whether the "
    "paper's computation is repeated, the second what a bead does.</p>\n"
    "<p>Lengths are in ℓ = 23 mm (half the length of the lines that model the magnet), times in 1/γ = 3.2 "
    "ms, so that a drive ω = 0.201 is 10 Hz. The command below a number "
    "computes it again and prints JSON; the text after the # says how to read the number off that. Put "
    "<code>rigid</code> for "
    "<code>farago2020</code> to get the other column, and a drive for <code>OMEGA</code>.</p>\n";

void fst_report_text(FILE *out, const char *text)
{
    for (const char *c = text; *c; ++c) {
        switch (*c) {
        case '<':
            fputs("&lt;", out);
            break;
        case '>':
            fputs("&gt;", out);
            break;
        case '&':
            fputs("&amp;", out);
            break;
        case '"':
            fputs("&quot;", out);
            break;
        default:
            fputc(*c, out);
        }
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

/* Base 64: three bytes become four letters. */
static void write_base64(FILE *out, FILE *in)
{
    static const char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    unsigned char bytes[3];
    for (size_t got; (got = fread(bytes, 1, 3, in)) > 0;) {
        memset(bytes + got, 0, 3 - got);
        unsigned word = (unsigned)bytes[0] << 16 | (unsigned)bytes[1] << 8 | bytes[2];
        fputc(letters[word >> 18], out);
        fputc(letters[word >> 12 & 63], out);
        fputc(got > 1 ? letters[word >> 6 & 63] : '=', out);
        fputc(got > 2 ? letters[word & 63] : '=', out);
    }
}

fst_status fst_report_image(FILE *out, const char *path, const char *alternative, fst_error *error)
{
    FILE *in = fopen(path, "rb");
    if (!in)
        return fst_fail(error, FST_IO, path, "cannot read the figure again: %s", strerror(errno));
    fputs("<img alt=\"", out);
    fst_report_text(out, alternative);
    /* A figure that is an image of its own keeps its names and styles to itself. */
    fputs("\" src=\"data:image/svg+xml;base64,", out);
    write_base64(out, in);
    fputs("\">\n", out);
    int failed = ferror(in);
    (void)fclose(in);
    return failed ? fst_fail(error, FST_IO, path, "cannot read the figure again") : FST_OK;
}
