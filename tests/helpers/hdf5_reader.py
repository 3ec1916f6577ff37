"""Reads HDF5 files by HDF5's own library, called through ctypes: none of festoon's code takes part."""

import ctypes
import ctypes.util
import unittest


class Hdf5:
    """Columns of doubles in a file of HDF5, read by the C library alone."""

    def __init__(self, path, writable=0):
        names = ["libhdf5_serial.so.103", "libhdf5.so.103", ctypes.util.find_library("hdf5_serial"),
                 ctypes.util.find_library("hdf5")]
        for name in filter(None, names):
            try:
                self.library = ctypes.CDLL(name)
                break
            except OSError:
                pass
        else:
            raise unittest.SkipTest("no shared library of HDF5")
        self.library.H5open()
        for function in ("H5Fopen", "H5Dopen2", "H5Oopen", "H5Dget_space", "H5Dget_type", "H5Aopen", "H5Aget_type"):
            getattr(self.library, function).restype = ctypes.c_int64
        self.library.H5Sget_simple_extent_npoints.restype = ctypes.c_int64
        self.library.H5Lget_name_by_idx.restype = ctypes.c_ssize_t
        self.library.H5Tget_size.restype = ctypes.c_size_t
        self.double = ctypes.c_int64.in_dll(self.library, "H5T_NATIVE_DOUBLE_g")
        self.file = ctypes.c_int64(self.library.H5Fopen(path.encode(), writable, ctypes.c_int64(0)))
        assert self.file.value >= 0, path

    def close(self):
        self.library.H5Fclose(self.file)

    def names(self):
        by_name, rising, default = 0, 0, ctypes.c_int64(0)
        found, text = [], ctypes.create_string_buffer(256)
        for place in range(self.count()):
            size = self.library.H5Lget_name_by_idx(self.file, b".", by_name, rising, ctypes.c_uint64(place), text,
                                                   ctypes.c_size_t(256), default)
            assert size > 0, place
            found.append(text.value.decode())
        return found

    def count(self):
        class Info(ctypes.Structure):
            _fields_ = [("storage", ctypes.c_int), ("links", ctypes.c_uint64), ("greatest", ctypes.c_int64),
                        ("mounted", ctypes.c_bool)]
        info = Info()
        assert self.library.H5Gget_info(self.file, ctypes.byref(info)) >= 0
        return info.links

    def resize(self, name, rows):
        data_set = ctypes.c_int64(self.library.H5Dopen2(self.file, name.encode(), ctypes.c_int64(0)))
        assert self.library.H5Dset_extent(data_set, ctypes.byref(ctypes.c_uint64(rows))) >= 0
        self.library.H5Dclose(data_set)

    def column(self, name):
        data_set = ctypes.c_int64(self.library.H5Dopen2(self.file, name.encode(), ctypes.c_int64(0)))
        space = ctypes.c_int64(self.library.H5Dget_space(data_set))
        values = (ctypes.c_double * self.library.H5Sget_simple_extent_npoints(space))()
        everything = ctypes.c_int64(0)
        assert self.library.H5Dread(data_set, self.double, everything, everything, everything, values) >= 0
        self.library.H5Sclose(space)
        self.library.H5Dclose(data_set)
        return list(values)

    def texts(self, name):
        """A data set of texts of a fixed length."""
        data_set = ctypes.c_int64(self.library.H5Dopen2(self.file, name.encode(), ctypes.c_int64(0)))
        space = ctypes.c_int64(self.library.H5Dget_space(data_set))
        kind = ctypes.c_int64(self.library.H5Dget_type(data_set))
        size, everything = self.library.H5Tget_size(kind), ctypes.c_int64(0)
        values = ctypes.create_string_buffer(size * self.library.H5Sget_simple_extent_npoints(space))
        assert self.library.H5Dread(data_set, kind, everything, everything, everything, values) >= 0
        for close, handle in (("H5Tclose", kind), ("H5Sclose", space), ("H5Dclose", data_set)):
            getattr(self.library, close)(handle)
        return [values.raw[i:i + size].split(b"\0")[0].decode() for i in range(0, len(values), size)]

    def attribute(self, name, key):
        """An attribute with a text, of a data set or, if name is None, of the file."""
        data_set = ctypes.c_int64(self.library.H5Oopen(self.file, (name or "/").encode(), ctypes.c_int64(0)))
        attribute = ctypes.c_int64(self.library.H5Aopen(data_set, key.encode(), ctypes.c_int64(0)))
        kind = ctypes.c_int64(self.library.H5Aget_type(attribute))
        text = ctypes.create_string_buffer(self.library.H5Tget_size(kind) + 1)
        assert self.library.H5Aread(attribute, kind, text) >= 0
        for close, handle in (("H5Tclose", kind), ("H5Aclose", attribute), ("H5Oclose", data_set)):
            getattr(self.library, close)(handle)
        return text.value.decode()
