/* Graze: glossy surfaces come out right, fast. This header includes all others. */
#ifndef GRAZE_GRAZE_H
#define GRAZE_GRAZE_H

#include "graze/brdf.h"
#include "graze/brdf_batch.h"
#include "graze/brdf_light.h"
#include "graze/error.h"
#include "graze/export.h"
#include "graze/material.h"
#include "graze/scene.h"
#include "graze/trace.h"
#include "graze/vector.h"

#endif
