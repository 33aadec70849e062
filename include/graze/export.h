/* GRAZE_API: the mark of functions that the libraries show. */
#ifndef GRAZE_EXPORT_H
#define GRAZE_EXPORT_H

#if defined(__GNUC__)
#define GRAZE_API __attribute__((visibility("default")))
#else
#define GRAZE_API
#endif

#endif
