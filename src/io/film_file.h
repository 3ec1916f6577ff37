/* film_file.h - whether the file of a film is whole. */
#ifndef FST_IO_FILM_FILE_H
#define FST_IO_FILM_FILE_H

#include <festoon/festoon.h>

/* Check a film of `format` ("mp4" or "gif") with `frames` pictures. ffmpeg may report success on a full disk
 * although no player opens the file.  FST_IO: it is not whole, and the sentence says what is missing; `name`
 * stands for it. */
fst_status fst_film_file_check(const char *path, const char *format, int frames, const char *name,
                               fst_error *error);

#endif
