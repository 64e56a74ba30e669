/* method/nlopt_facts.h - names of NLopt's results, and keeping NLopt 2.7.1 away from copies that it
 * has no memory for. */
#ifndef AMBULO_METHOD_NLOPT_FACTS_H
#define AMBULO_METHOD_NLOPT_FACTS_H

/* NLopt's name of its result, without the prefix. */
const char *ambulo__nlopt_name(int result);

/* nlopt_set_local_optimizer copies its argument (nlopt_copy) into one small block and three of n
 * doubles without looking at what malloc returns for them: without memory the process dies. 1 when
 * malloc has all four at once right now; what this function took is free again when it returns,
 * and the copy finds it. Asked right before each such call. */
int ambulo__nlopt_can_copy(unsigned n);

#endif
