/* hdf5_present.h - whether trajectories can be HDF5 files. */
#ifndef FST_IO_HDF5_PRESENT_H
#define FST_IO_HDF5_PRESENT_H

/* 1 if the module for HDF5 lies where it would be loaded from. */
int fst_hdf5_present(void);

#endif
