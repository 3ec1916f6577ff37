/* log.c - whose is the log beside a database?
 *
 * SQLite writes a log of the right name into a database before anything else, whatever the log belongs to:
 *
 *  rm a.db; mv b.db a.db     a.db-wal of the deleted file is still there, and would be written into b's rows
 *  cp old/a.db .             the log beside it is newer, or older, than the copy
 *
 * So festoon reads the log itself before SQLite does.  A sweep's database bears a mark, 16 random bytes as
 * text, on its first page (in the definition of the table `seal`) and on its second (in that table's only row,
 * which also counts the transactions).  Every transaction changes the second page, so the log of every
 * transaction contains it:
 *
 *  database   | page 1: mark | page 2: mark, commits = 41 | rows ...
 *  its log    | ... page 2: mark, commits = 42 | rows | ... page 2: mark, commits = 43 | rows |
 *
 *  no mark, or another mark            FST_LOG_FOREIGN   refuse, and change nothing
 *  our mark, but fewer commits         FST_LOG_FOREIGN   an older log: it would undo what was committed since
 *  our mark, and a damaged frame       FST_LOG_DAMAGED   SQLite would silently stop there: tell of it
 *  our mark                            FST_LOG_OWN       SQLite may use it
 */
#define _GNU_SOURCE /* memmem(), getrandom() */
#include "sweep/log.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/error.h"
#include "host/regular_file.h"

static const char *const ENDINGS[] = {"-wal", "-journal", "-shm"};

/* ------------------------------------------------------------------ marks */

fst_status fst_mark_make(char mark[FST_MARK_SIZE], fst_error *error)
{
    unsigned char bytes[16];
    if (getrandom(bytes, sizeof bytes, 0) != (ssize_t)sizeof bytes)
        return fst_fail(error, FST_IO, "getrandom", "no random numbers: %s", strerror(errno));
    char *at = mark + snprintf(mark, FST_MARK_SIZE, "%s", FST_MARK_PREFIX);
    for (size_t i = 0; i < sizeof bytes; ++i)
        at += snprintf(at, 3, "%02x", bytes[i]);
    return FST_OK;
}

int fst_mark_find(const void *bytes, size_t size, char mark[FST_MARK_SIZE])
{
    const size_t prefix = strlen(FST_MARK_PREFIX), whole = FST_MARK_SIZE - 1;
    const char *at = bytes, *end = at + size;
    while ((at = memmem(at, (size_t)(end - at), FST_MARK_PREFIX, prefix)) != NULL) {
        size_t length = prefix;
        while (length < whole && at + length < end && strchr("0123456789abcdef", at[length]) && at[length])
            ++length;
        if (length == whole) {
            memcpy(mark, at, whole);
            mark[whole] = '\0';
            return 1;
        }
        at += prefix;
    }
    return 0;
}

/* Read the number of transactions from the page of the table `seal`, which holds one row; -1: the row is not
 * there.  Its cell: the sizes of payload and key, a byte each; a head of four bytes (its own size, the types of
 * the three columns); the mark; the number. */
static int64_t transactions_on(const unsigned char *page, size_t size, const char *mark)
{
    enum { MARK = FST_MARK_SIZE - 1, CELL = 6 + MARK };
    static const int SIZES[] = {-1, 1, 2, 3, 4, 6, 8, -1, 0, 0}; /* bytes of SQLite's integer types */
    const size_t at = (size_t)page[8] << 8 | page[9];
    if (page[0] != 0x0d || page[3] != 0 || page[4] != 1 || at + CELL > size)
        return -1;
    const unsigned char *cell = page + at;
    const int type = cell[5], bytes = type < 10 ? SIZES[type] : -1;
    if (cell[2] != 4 || memcmp(cell + 6, mark, MARK) != 0 || bytes < 0 || at + CELL + (size_t)bytes > size)
        return -1;
    uint64_t number = type == 9;
    for (int i = 0; i < bytes; ++i)
        number = number << 8 | cell[6 + MARK + i];
    return number <= INT64_MAX ? (int64_t)number : -1;
}

/* ------------------------------------------------------------------ the write-ahead log
 *
 * SQLite's format: a head of 32 bytes, then frames; a frame is a head of 24 bytes and a page.
 *
 *     head    magic, version, size of a page, number, salt 1, salt 2, sum (2)
 *     frame   page, size of the database (0: the transaction goes on), salt 1, salt 2, sum (2)
 *
 * Each is a number of four bytes, the highest byte first.  A frame is valid if its salts are those of the head
 * and its sum continues the sum of the frame before; SQLite reads up to the first frame that is not.  Our logs
 * are cut to length zero before they begin again, with new salts.  So a whole frame that has the salts of the
 * head and is not valid is damaged, or was being written when the power failed.
 */

enum { HEAD_SIZE = 32, FRAME_SIZE = 24, SEAL_PAGE = 2 };

static uint32_t number_at(const unsigned char *bytes)
{
    return (uint32_t)bytes[0] << 24 | (uint32_t)bytes[1] << 16 | (uint32_t)bytes[2] << 8 | bytes[3];
}

typedef struct log_walk {
    int descriptor;
    int swapped; /* the sums take numbers with the lowest byte first */
    uint32_t page_size, salts[2], sum[2];
    int own, foreign;   /* whether such marks were found */
    int commits;        /* transactions that SQLite would use */
    int64_t seal, last; /* the count of transactions in the latest page of the seal, and in the last of the
                           transactions above; -1: none */
    int damaged;
    int reason; /* errno of a read that failed; 0: none did */
} log_walk;

static void add_up(const log_walk *w, const unsigned char *bytes, size_t size, uint32_t sum[2])
{
    for (size_t i = 0; i + 8 <= size; i += 8) {
        uint32_t first = number_at(bytes + i), second = number_at(bytes + i + 4);
        if (w->swapped) {
            first = __builtin_bswap32(first);
            second = __builtin_bswap32(second);
        }
        sum[0] += first + sum[1];
        sum[1] += second + sum[0];
    }
}

/* Read exactly `size` bytes; 0 where the file ends before, or where reading failed, with its errno
 * in *reason. */
static int read_all(int descriptor, void *bytes, size_t size, off_t place, int *reason)
{
    const ssize_t got = fst_read_at(descriptor, bytes, size, place);
    if (got < 0)
        *reason = errno;
    return got == (ssize_t)size;
}

static int read_head(log_walk *w)
{
    unsigned char head[HEAD_SIZE];
    if (!read_all(w->descriptor, head, sizeof head, 0, &w->reason))
        return 0;
    w->swapped = number_at(head) == 0x377f0682u;
    w->page_size = number_at(head + 8);
    add_up(w, head, 24, w->sum);
    for (int i = 0; i < 2; ++i)
        w->salts[i] = number_at(head + 16 + 4 * i);
    const int good = (number_at(head) & 0xfffffffeu) == 0x377f0682u && number_at(head + 4) == 3007000 &&
                     w->page_size >= 512 && w->page_size <= 65536 && (w->page_size & (w->page_size - 1)) == 0 &&
                     w->sum[0] == number_at(head + 24) && w->sum[1] == number_at(head + 28);
    w->damaged = !good;
    return good;
}

static void look_for_marks(log_walk *w, const unsigned char *page, const char *mark)
{
    char found[FST_MARK_SIZE];
    if (!fst_mark_find(page, w->page_size, found))
        return;
    if (strcmp(found, mark) == 0)
        w->own = 1;
    else
        w->foreign = 1;
}

/* Whether an invalid frame belongs to this log and is damaged.  A frame of an older log has other salts, which
 * agree in about half of their bits; a damaged one has nearly all of them right. */
static int has_salts(const log_walk *w, const unsigned char *frame)
{
    int differing = 0;
    for (int i = 0; i < 2; ++i)
        differing += __builtin_popcount(number_at(frame + 8 + 4 * i) ^ w->salts[i]);
    return differing <= 4;
}

static void walk_frames(log_walk *w, unsigned char *frame, const char *mark)
{
    off_t place = HEAD_SIZE;
    for (; read_all(w->descriptor, frame, FRAME_SIZE + w->page_size, place, &w->reason);
         place += FRAME_SIZE + w->page_size) {
        uint32_t sum[2] = {w->sum[0], w->sum[1]};
        add_up(w, frame, 8, sum);
        add_up(w, frame + FRAME_SIZE, w->page_size, sum);
        if (number_at(frame + 8) != w->salts[0] || number_at(frame + 12) != w->salts[1] ||
            sum[0] != number_at(frame + 16) || sum[1] != number_at(frame + 20)) {
            w->damaged = has_salts(w, frame);
            return;
        }
        memcpy(w->sum, sum, sizeof sum);
        look_for_marks(w, frame + FRAME_SIZE, mark);
        if (number_at(frame) == SEAL_PAGE)
            w->seal = transactions_on(frame + FRAME_SIZE, w->page_size, mark);
        if (number_at(frame + 4) != 0) {
            ++w->commits;
            w->last = w->seal;
        }
    }
}

/* The count of transactions in the database file itself, without its log; -1: none. */
static int64_t transactions_in(int database, uint32_t page_size, const char *mark, int *reason)
{
    unsigned char *page = malloc(page_size);
    const int there = page && read_all(database, page, page_size, (off_t)(SEAL_PAGE - 1) * page_size, reason);
    const int64_t number = there ? transactions_on(page, page_size, mark) : -1;
    free(page);
    return number;
}

/* A checkpoint copies pages from the log into the database and adds nothing.  So an undamaged log whose last
 * transaction is older than the database's was left behind when the database was moved away and back; it would
 * undo newer transactions. */
static fst_log_state look_at_wal(int descriptor, int database, const char *mark, int *reason)
{
    struct stat there;
    log_walk w = {.descriptor = descriptor, .seal = -1, .last = -1};
    if (fstat(descriptor, &there) != 0 || there.st_size <= HEAD_SIZE)
        return FST_LOG_NONE;
    const int good = read_head(&w);
    *reason = w.reason;
    if (!good)
        return there.st_size > HEAD_SIZE + FRAME_SIZE + 4096 ? FST_LOG_DAMAGED : FST_LOG_NONE;
    unsigned char *frame = malloc(FRAME_SIZE + w.page_size);
    if (!frame) {
        *reason = ENOMEM;
        return FST_LOG_NONE;
    }
    walk_frames(&w, frame, mark);
    free(frame);
    *reason = w.reason;
    if (w.commits > 0 && !w.own)
        return FST_LOG_FOREIGN;
    if (w.foreign)
        return FST_LOG_FOREIGN;
    if (!w.damaged && w.last >= 0 && w.last < transactions_in(database, w.page_size, mark, reason))
        return FST_LOG_FOREIGN;
    return w.damaged ? FST_LOG_DAMAGED : w.commits > 0 ? FST_LOG_OWN : FST_LOG_NONE;
}

/* ------------------------------------------------------------------ the rollback journal
 *
 * It holds pages as they were before the transaction.  SQLite ignores a journal whose first byte is zero.
 */

static fst_log_state look_at_journal(int descriptor, const char *mark, int *reason)
{
    enum { PIECE = 65536 };
    struct stat there;
    unsigned char *bytes = malloc(PIECE);
    int own = 0, foreign = 0;
    if (!bytes || fstat(descriptor, &there) != 0 || there.st_size <= 512 ||
        !read_all(descriptor, bytes, 1, 0, reason) || bytes[0] == 0) {
        free(bytes);
        return FST_LOG_NONE;
    }
    /* Pieces overlap by the length of a mark, so that none is cut in two. */
    for (off_t place = 0; place < there.st_size; place += PIECE - FST_MARK_SIZE) {
        const off_t rest = there.st_size - place;
        const size_t size = rest < PIECE ? (size_t)rest : PIECE;
        char found[FST_MARK_SIZE];
        if (!read_all(descriptor, bytes, size, place, reason))
            break;
        if (fst_mark_find(bytes, size, found))
            *(strcmp(found, mark) == 0 ? &own : &foreign) = 1;
    }
    free(bytes);
    return own && !foreign ? FST_LOG_OWN : FST_LOG_FOREIGN;
}

/* ------------------------------------------------------------------ */

static int name_log(char name[FST_LOG_NAME_SIZE], const char *path, const char *ending)
{
    return snprintf(name, FST_LOG_NAME_SIZE, "%s%s", path, ending) < FST_LOG_NAME_SIZE;
}

fst_log_state fst_log_look(const char *path, const char *mark, char name[FST_LOG_NAME_SIZE], int *reason)
{
    fst_log_state state = FST_LOG_NONE;
    *reason = 0;
    const int database = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    for (int i = 0; i < 2 && state != FST_LOG_FOREIGN; ++i) {
        const int descriptor =
            name_log(name, path, ENDINGS[i]) ? open(name, O_RDONLY | O_CLOEXEC | O_NONBLOCK) : -1;
        if (descriptor < 0)
            continue;
        const fst_log_state found = i == 0 ? look_at_wal(descriptor, database, mark, reason)
                                           : look_at_journal(descriptor, mark, reason);
        (void)close(descriptor);
        state = found > state ? found : state;
        if (*reason || found == FST_LOG_FOREIGN)
            break;
    }
    if (database >= 0)
        (void)close(database);
    return *reason ? FST_LOG_NONE : state;
}

fst_status fst_log_remove(const char *path, fst_error *error)
{
    char name[FST_LOG_NAME_SIZE];
    for (int i = 0; i < 3; ++i)
        if (!name_log(name, path, ENDINGS[i]) || (unlink(name) != 0 && errno != ENOENT))
            return fst_fail(error, FST_IO, name, "this file of a deleted database cannot be removed: %s",
                            strerror(errno));
    return FST_OK;
}

void fst_log_move(const char *path, const char *to)
{
    char from[FST_LOG_NAME_SIZE], name[FST_LOG_NAME_SIZE];
    for (int i = 0; i < 3; ++i)
        if (name_log(from, path, ENDINGS[i]) && name_log(name, to, ENDINGS[i]))
            (void)rename(from, name);
}
