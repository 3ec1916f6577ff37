/* fields.h - by which option a field of the library's options is given. */
#ifndef FST_CLI_FIELDS_H
#define FST_CLI_FIELDS_H

/* The library says where a fault lies by the field, "fst_sweep_options.lanes"; a person typed --lanes.  The
 * option of a field; what is no field of the table comes back as it is. */
const char *option_of_field(const char *field);

#endif
