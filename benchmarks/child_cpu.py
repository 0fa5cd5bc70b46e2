"""CPU time of other processes."""

import resource


def with_cpu_of_children(call):
    """What a call returns, and the CPU of the processes that it ran to their ends, with their own children [s]."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    result = call()
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return result, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
