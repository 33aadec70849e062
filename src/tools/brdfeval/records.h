/* Records in, answers out. */
#ifndef TOOLS_BRDFEVAL_RECORDS_H
#define TOOLS_BRDFEVAL_RECORDS_H

#include "base/records.h"
#include "tools/brdfeval/evaluation.h"

typedef struct records_job {
    const evaluation *evaluation;
    record_format in, out;
    int flush; /* write answers at least every so many records; 0: as is best */
    int threads;
} records_job;

/* From standard input to standard output. */
graze_status records_answer(const records_job *, const graze_report *);

/* The one answer of a query without input. */
graze_status records_answer_once(const records_job *, const graze_report *);

#endif
