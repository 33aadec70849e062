/* The loadable module with OpenImageIO in it. */
#ifndef IMAGE_MODULE_H
#define IMAGE_MODULE_H

#include "base/report.h"
#include "image/oiio.h"

/* Opens the module, or gives the one that is open: it lies in graze/oiio.so beside libgraze.so, or in
 * ../lib/graze/oiio.so as seen from an executable. `file` is the picture for whose sake it is opened. */
graze_status image_module_open(const image_oiio **, const char *file, const graze_report *);

#endif
