/* problem/member_forms.h - short forms of the rows of members.c, which alone includes it.
 *
 * Each begins a row of the table of OF, a structure; flags, quantity and label may follow.
 * `usual`: one number or two. */
#ifndef AMBULO_PROBLEM_MEMBER_FORMS_H
#define AMBULO_PROBLEM_MEMBER_FORMS_H

#include "problem/members.h"

/* NOLINTBEGIN(bugprone-macro-parentheses): what stands in them is a row's, not an expression's */
enum {
  OFF = AMBULO__MAY_BE_OFF,
  INFINITE = AMBULO__MAY_BE_INFINITE,
  EXACT = AMBULO__EXACT_RANGE,
  REQUIRED = AMBULO__REQUIRED,
  RISING = AMBULO__RISING,
  APART = AMBULO__READ_APART,
  LENGTH = AMBULO__BODY_LENGTH
};

#define AT(key_, name, type_) .key = key_, .at = offsetof(OF, name), .type = type_
#define COUNT_OF(name, item) .count = (int)(sizeof(((OF *)0)->name) / sizeof(item))
#define NUMBER(key, name, low_, high_, ...)                                                        \
  AT(key, name, AMBULO__NUMBER), COUNT_OF(name, double), .low = low_, .high = high_,               \
                                                         .usual = {__VA_ARGS__}
#define ANGLE(key, name, low_, high_, ...)                                                         \
  AT(key, name, AMBULO__FILE_ANGLE), COUNT_OF(name, double), .low = low_, .high = high_,           \
                                                             .usual = {__VA_ARGS__}
#define INTEGER(key, name, low_, high_, usual_)                                                    \
  AT(key, name, AMBULO__INTEGER), COUNT_OF(name, int), .low = low_, .high = high_, .usual = {usual_}
#define INDEX(key, name) AT(key, name, AMBULO__INDEX), COUNT_OF(name, int), .usual = {-1, -1}
#define FLAG(key, name, usual_) AT(key, name, AMBULO__FLAG), .count = 1, .usual = {usual_}
#define CHOICE(key, name, words_, first, usual_)                                                   \
  AT(key, name, AMBULO__CHOICE), .count = 1, .words = words_,                                      \
                                 .word_count = (int)(sizeof(words_) / sizeof *(words_)),           \
                                 .first_word = first, .usual = {usual_}
#define TEXT(key, name) AT(key, name, AMBULO__TEXT), .usual = {0}
#define ARRAY(key, name, extent_, count_, low_, high_)                                             \
  AT(key, name, AMBULO__NUMBER_ARRAY), .extent = extent_, .count = count_, .low = low_,            \
                                       .high = high_, .usual = {0}
#define COUNTER(name) AT(NULL, name, AMBULO__INTEGER), .count = 1
#define ITEMS(key, name, counter, size, structure)                                                 \
  AT(key, name, AMBULO__ITEMS), .count_at = offsetof(OF, counter),                                 \
                                .size_at = offsetof(ambulo_problem_definition, size),              \
                                .of = &ambulo__##structure##_members, .usual = {0}
#define PART(key, name, size)                                                                      \
  AT(key, name, AMBULO__PART), .size_at = offsetof(OF, size), .of = &ambulo__##name##_members
#define BORROWED(name) AT(NULL, name, AMBULO__BORROWED)
#define TABLE(key, name)                                                                           \
  const ambulo__structure ambulo__##name##_members = {key, sizeof(OF), name,                       \
                                                      (int)(sizeof(name) / sizeof *(name))}
/* NOLINTEND(bugprone-macro-parentheses) */

#endif
