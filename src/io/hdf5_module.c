/* hdf5_module.c - trajectories in HDF5, as the module festoon-hdf5.so.
 *
 * The file: one extendible data set of doubles for each column, with the attributes `unit` and `description`, and of a
 * sweep one of texts; at the root the attributes `program`, `version`, `units`, `scene` (YAML), `result` (JSON, as
 * `festoon run --json`) and `complete` (a boolean).
 */
#include "io/hdf5_module.h"

#include <hdf5.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "io/hdf5_session.h"

/* Rows in a chunk. */
#define CHUNK 4096

/* Bytes of a text of a row, with its end. */
#define TEXT 256

#define PROGRAM "festoon"

#define UNITS                                                                                                  \
    "scaled: lengths in l (magnet.half_length), times in 1/gamma (friction.gamma), fields in B0, masses in "   \
    "the "                                                                                                     \
    "bead's mass; see each column's unit"

struct fst_hdf5_writer {
    hid_t file;
    fst_hdf5_image image;
    hid_t *sets; /* the data set of each column, and that of texts */
    const fst_column_info *const *columns;
    int count;
    hsize_t written; /* rows in the file */
    size_t pending;  /* rows in the buffer */
    double *buffer;  /* count columns of CHUNK rows */
    char *texts;     /* CHUNK texts; NULL: rows have none */
    hid_t text_type;
    const char *name; /* the name that the file will have, for messages */
};

/* ---------------------------------------------------------------- attributes */

/* Negative: HDF5 cannot make it. */
static hid_t type_of_text(size_t size)
{
    const hid_t type = H5Tcopy(H5T_C_S1);
    if (type >= 0 && H5Tset_size(type, size) >= 0 && H5Tset_cset(type, H5T_CSET_UTF8) >= 0)
        return type;
    fst_hdf5_close(type, -1);
    return -1;
}

static int write_text(hid_t object, const char *name, const char *text)
{
    hid_t type = type_of_text(strlen(text) + 1), space = H5Screate(H5S_SCALAR);
    hid_t attribute = H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
    int failed = attribute < 0 || H5Awrite(attribute, type, text) < 0;
    failed = (attribute >= 0 && H5Aclose(attribute) < 0) || failed;
    fst_hdf5_close(type, space);
    return failed;
}

/* The boolean that h5py knows: an enumeration of one byte.  Negative: HDF5 cannot make it. */
static hid_t boolean_type(void)
{
    hid_t type = H5Tenum_create(H5T_NATIVE_INT8);
    const signed char no = 0, yes = 1;
    if (type >= 0 && H5Tenum_insert(type, "FALSE", &no) >= 0 && H5Tenum_insert(type, "TRUE", &yes) >= 0)
        return type;
    fst_hdf5_close(type, -1);
    return -1;
}

static int write_boolean(hid_t object, const char *name, int truth)
{
    signed char value = truth != 0;
    hid_t type = boolean_type(), space = H5Screate(H5S_SCALAR);
    hid_t attribute = H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
    int failed = attribute < 0 || H5Awrite(attribute, type, &value) < 0;
    failed = (attribute >= 0 && H5Aclose(attribute) < 0) || failed;
    fst_hdf5_close(type, space);
    return failed;
}

/* A text attribute as a new string; NULL where there is none of fixed length. */
static char *read_text(hid_t object, const char *name)
{
    hid_t attribute = H5Aopen(object, name, H5P_DEFAULT);
    if (attribute < 0)
        return NULL;
    hid_t type = H5Aget_type(attribute), space = H5Aget_space(attribute);
    char *text = NULL;
    size_t size = type >= 0 ? H5Tget_size(type) : 0;
    int usable = type >= 0 && H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) == 0 &&
                 size <= FST_SCENE_SIZE_LIMIT && H5Sget_simple_extent_npoints(space) == 1;
    if (usable)
        text = calloc(size + 1, 1);
    if (text && H5Aread(attribute, type, text) < 0) {
        free(text);
        text = NULL;
    }
    fst_hdf5_close(type, space);
    (void)H5Aclose(attribute);
    return text;
}

/* 1, 0, or -1 where there is no such boolean. */
static int read_boolean(hid_t object, const char *name)
{
    hid_t attribute = H5Aopen(object, name, H5P_DEFAULT);
    if (attribute < 0)
        return -1;
    signed char value = -1;
    hid_t type = boolean_type(), space = H5Aget_space(attribute);
    if (H5Sget_simple_extent_npoints(space) != 1 || H5Aread(attribute, type, &value) < 0)
        value = -1;
    fst_hdf5_close(type, space);
    (void)H5Aclose(attribute);
    return value;
}

/* ---------------------------------------------------------------- writing */

static fst_status fail_write(const fst_hdf5_writer *writer, fst_error *error)
{
    return fst_fail(error, FST_IO, writer->name, "writing this file failed: HDF5 refused, and did not say why");
}

/* Chunked, with checksums, and compressed where this HDF5 can.  Negative: HDF5 cannot make it. */
static hid_t storage_of_column(void)
{
    const hsize_t chunk = CHUNK;
    const htri_t deflates = H5Zfilter_avail(H5Z_FILTER_DEFLATE);
    hid_t storage = H5Pcreate(H5P_DATASET_CREATE);
    /* Without times the same run gives the same bytes. */
    if (storage >= 0 && deflates >= 0 && H5Pset_obj_track_times(storage, 0) >= 0 &&
        H5Pset_chunk(storage, 1, &chunk) >= 0 && H5Pset_shuffle(storage) >= 0 &&
        (!deflates || H5Pset_deflate(storage, 1) >= 0) && H5Pset_fletcher32(storage) >= 0)
        return storage;
    if (storage >= 0)
        (void)H5Pclose(storage);
    return -1;
}

static int create_columns(fst_hdf5_writer *writer, const char *texts)
{
    const hsize_t none = 0, unlimited = H5S_UNLIMITED;
    hid_t space = H5Screate_simple(1, &none, &unlimited);
    hid_t storage = storage_of_column();
    /* Whole chunks are written at once, so a cache would only hold copies of them. */
    hid_t access = H5Pcreate(H5P_DATASET_ACCESS);
    int failed = space < 0 || storage < 0 || access < 0 || H5Pset_chunk_cache(access, 1, 0, 1.0) < 0;
    for (int i = 0; i < writer->count && !failed; ++i) {
        const fst_column_info *column = writer->columns[i];
        hid_t set = H5Dcreate2(writer->file, column->name, H5T_IEEE_F64LE, space, H5P_DEFAULT, storage, access);
        writer->sets[i] = set;
        failed =
            set < 0 || write_text(set, "unit", column->unit) || write_text(set, "description", column->doc);
    }
    if (texts && !failed) {
        writer->text_type = type_of_text(TEXT);
        writer->sets[writer->count] =
            H5Dcreate2(writer->file, texts, writer->text_type, space, H5P_DEFAULT, storage, access);
        failed = writer->sets[writer->count] < 0;
    }
    if (access >= 0)
        (void)H5Pclose(access);
    if (storage >= 0)
        (void)H5Pclose(storage);
    fst_hdf5_close(-1, space);
    return failed;
}

/* Close everything; 1 where HDF5 cannot. */
static int close_file(fst_hdf5_writer *writer)
{
    int failed = 0;
    for (int i = 0; i <= writer->count; ++i)
        if (writer->sets[i] >= 0)
            failed = H5Dclose(writer->sets[i]) < 0 || failed;
    fst_hdf5_close(writer->text_type, -1);
    return (writer->file >= 0 && H5Fclose(writer->file) < 0) || failed;
}

static void free_writer(fst_hdf5_writer *writer)
{
    free(writer->image.bytes);
    free(writer->sets);
    free(writer->buffer);
    free(writer->texts);
    free(writer);
}

static fst_status create(const char *name, const fst_column_info *const *columns, int count, const char *texts,
                         const char *scene, fst_hdf5_writer **out, fst_error *error)
{
    *out = NULL;
    fst_hdf5_writer *writer = calloc(1, sizeof *writer);
    if (!writer)
        return fst_fail(error, FST_NO_MEMORY, name, "out of memory");
    writer->columns = columns;
    writer->count = count;
    writer->file = writer->text_type = -1;
    writer->name = name;
    writer->sets = calloc((size_t)count + 1, sizeof *writer->sets);
    writer->buffer = malloc((size_t)count * CHUNK * sizeof *writer->buffer);
    writer->texts = texts ? malloc((size_t)CHUNK * TEXT) : NULL;
    if (!writer->sets || !writer->buffer || (texts && !writer->texts)) {
        free_writer(writer);
        return fst_fail(error, FST_NO_MEMORY, name, "out of memory");
    }
    for (int i = 0; i <= count; ++i)
        writer->sets[i] = -1;
    fst_hdf5_told before = fst_hdf5_quiet();
    writer->file = fst_hdf5_new(&writer->image);
    int failed = writer->file < 0 || write_text(writer->file, "program", PROGRAM) ||
                 write_text(writer->file, "version", fst_version()) ||
                 write_text(writer->file, "units", UNITS) || write_text(writer->file, "scene", scene) ||
                 create_columns(writer, texts);
    if (failed) {
        fail_write(writer, error);
        (void)close_file(writer);
        free_writer(writer);
    }
    fst_hdf5_as_before(before);
    if (failed)
        return FST_IO;
    *out = writer;
    return FST_OK;
}

/* Append the buffered rows to every column. */
static int flush_rows(fst_hdf5_writer *writer)
{
    if (writer->pending == 0)
        return 0;
    const hsize_t start = writer->written, added = writer->pending, total = start + added;
    hid_t memory = H5Screate_simple(1, &added, NULL);
    int failed = memory < 0;
    for (int i = 0; i < writer->count + (writer->texts != NULL) && !failed; ++i) {
        const int is_text = i == writer->count;
        failed = H5Dset_extent(writer->sets[i], &total) < 0;
        hid_t space = failed ? -1 : H5Dget_space(writer->sets[i]);
        failed =
            space < 0 || H5Sselect_hyperslab(space, H5S_SELECT_SET, &start, NULL, &added, NULL) < 0 ||
            H5Dwrite(writer->sets[i], is_text ? writer->text_type : H5T_NATIVE_DOUBLE, memory, space,
                     H5P_DEFAULT, is_text ? (void *)writer->texts : writer->buffer + (size_t)i * CHUNK) < 0;
        fst_hdf5_close(-1, space);
    }
    fst_hdf5_close(-1, memory);
    writer->written = total;
    writer->pending = 0;
    return failed;
}

static fst_status row(fst_hdf5_writer *writer, const double *values, const char *text, fst_error *error)
{
    for (int i = 0; i < writer->count; ++i)
        writer->buffer[(size_t)i * CHUNK + writer->pending] = values[i];
    if (writer->texts) { /* bytes behind the end of a text are zeros */
        char *place = writer->texts + writer->pending * TEXT;
        memset(place, 0, TEXT);
        (void)snprintf(place, TEXT, "%s", text ? text : "");
    }
    if (++writer->pending < CHUNK)
        return FST_OK;
    fst_hdf5_told before = fst_hdf5_quiet();
    hsize_t size = 0;
    const int failed = flush_rows(writer) || H5Fget_filesize(writer->file, &size) < 0;
    fst_hdf5_as_before(before);
    if (!failed && size > fst_hdf5_most())
        return fst_fail(
            error, FST_NO_MEMORY, writer->name,
            "this HDF5 file is made in memory, and it has grown beyond half of this computer's memory: "
            "choose a .csv file, or fewer samples");
    return failed ? fail_write(writer, error) : FST_OK;
}

static fst_status finish(fst_hdf5_writer *writer, const char *result, int complete, FILE *out, fst_error *error)
{
    fst_hdf5_told before = fst_hdf5_quiet();
    int failed = flush_rows(writer) || (result && write_text(writer->file, "result", result)) ||
                 write_boolean(writer->file, "complete", complete);
    failed = close_file(writer) || failed;
    const size_t length = fst_hdf5_length(&writer->image);
    const fst_status status = failed || length == 0 ? fail_write(writer, error) : FST_OK;
    if (status == FST_OK)
        (void)fwrite(writer->image.bytes, 1, length, out);
    free_writer(writer);
    fst_hdf5_as_before(before);
    return status;
}

static void abandon(fst_hdf5_writer *writer)
{
    fst_hdf5_told before = fst_hdf5_quiet();
    (void)close_file(writer);
    free_writer(writer);
    fst_hdf5_as_before(before);
}

/* ---------------------------------------------------------------- reading */

/* Read one column.  The first one sets the number of rows. */
static fst_status read_column(hid_t file, const char *path, const char *name, int first, double **data,
                              size_t *rows, fst_error *error)
{
    hid_t set = H5Dopen2(file, name, H5P_DEFAULT);
    if (set < 0)
        return fst_hdf5_is_starved()
                   ? fst_fail(error, FST_NO_MEMORY, path, "out of memory")
                   : fst_fail(error, FST_BAD_INPUT, path,
                              "the column %s is missing: this is not a trajectory of festoon", name);
    hid_t space = H5Dget_space(set), type = H5Dget_type(set);
    hsize_t length = 0;
    const char *problem = NULL;
    if (space < 0 || H5Sget_simple_extent_ndims(space) != 1 ||
        H5Sget_simple_extent_dims(space, &length, NULL) < 0 || type < 0 || H5Tget_class(type) != H5T_FLOAT)
        problem = "is not a list of numbers";
    else if (!first && length != *rows)
        problem = "has another length than the columns before it";
    else if (length > SIZE_MAX / sizeof **data || (length > 0 && H5Dget_storage_size(set) == 0))
        problem = "is damaged";
    else
        *data = malloc(length ? (size_t)length * sizeof **data : 1);
    fst_status status = FST_OK;
    if (!problem && !*data)
        status = fst_fail(error, FST_NO_MEMORY, path, "no memory for the %llu rows of the column %s",
                          (unsigned long long)length, name);
    else if (!problem && H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, *data) < 0)
        problem = "is damaged";
    if (problem)
        status = fst_fail(error, FST_BAD_INPUT, path, "the column %s %s", name, problem);
    *rows = (size_t)length;
    fst_hdf5_close(type, space);
    (void)H5Dclose(set);
    return status;
}

static fst_status read_root(hid_t file, const char *path, char **scene, char **result, int *complete,
                            fst_error *error)
{
    char *program = read_text(file, "program");
    int ours = program && strcmp(program, PROGRAM) == 0;
    free(program);
    if (!ours)
        return fst_fail(error, FST_BAD_INPUT, path, "this HDF5 file is not a trajectory of festoon");
    *scene = read_text(file, "scene");
    int said = read_boolean(file, "complete");
    if (!*scene || said < 0)
        return fst_fail(error, FST_BAD_INPUT, path, "the attribute %s is missing: the file is damaged",
                        *scene ? "complete" : "scene");
    *complete = said;
    if (result && !*result)
        *result = read_text(file, "result");
    return FST_OK;
}

/* Columns from `needed` to `count` that an older file lacks: zeros. */
static fst_status fill_columns(const char *path, int needed, int count, double **data, size_t rows,
                               fst_error *error)
{
    for (int i = needed; i < count; ++i) {
        data[i] = calloc(rows ? rows : 1, sizeof **data);
        if (!data[i])
            return fst_fail(error, FST_NO_MEMORY, path, "no memory for %zu rows", rows);
    }
    return FST_OK;
}

static fst_status read_file(const fst_hdf5_session *session, const char *path,
                            const fst_column_info *const *columns, int needed, int count, double **data,
                            size_t *rows, char **scene, char **result, int *complete, fst_error *error)
{
    fst_status status = FST_OK;
    const hid_t file = session->file;
    int later = 0;
    if (session->starved)
        status = fst_fail(error, FST_NO_MEMORY, path, "out of memory");
    else if (file < 0)
        status = fst_fail(error, FST_BAD_INPUT, path, "HDF5 cannot open this file: it is damaged or cut off");
    else
        status = read_root(file, path, scene, result, complete, error);
    for (int i = needed; i < count && status == FST_OK; ++i)
        later += H5Lexists(file, columns[i]->name, H5P_DEFAULT) > 0;
    const int there = later ? count : needed;
    for (int i = 0; i < there && status == FST_OK; ++i)
        status = read_column(file, path, columns[i]->name, i == 0, &data[i], rows, error);
    return status == FST_OK ? fill_columns(path, there, count, data, *rows, error) : status;
}

static fst_status read_all(const char *path, const char *bytes, size_t size,
                           const fst_column_info *const *columns, int needed, int count, double **data,
                           size_t *rows, char **scene, char **result, int *complete, fst_error *error)
{
    fst_status status = FST_BAD_INPUT;
    /* Where memory runs out HDF5 answers as to a damaged file: it must do so twice. */
    for (int i = 0; i < 2 && status == FST_BAD_INPUT; ++i) {
        fst_hdf5_session session;
        for (int k = 0; k < count; ++k) {
            free(data[k]);
            data[k] = NULL;
        }
        free(*scene);
        *scene = NULL;
        fst_hdf5_session_begin(bytes, size, &session);
        status = read_file(&session, path, columns, needed, count, data, rows, scene, result, complete, error);
        fst_hdf5_session_end(&session);
    }
    return status;
}

FST_API extern const fst_hdf5_module_table fst_hdf5_module;
const fst_hdf5_module_table fst_hdf5_module = {
    .version = FST_VERSION_STRING,
    .most = fst_hdf5_most,
    .create = create,
    .row = row,
    .finish = finish,
    .abandon = abandon,
    .read = read_all,
    .read_map = fst_hdf5_read_map,
};
