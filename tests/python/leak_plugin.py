"""For check_leaks.py: asks the leak sanitizer, in a living interpreter, what has been lost."""
import ctypes
import gc


def look():
    gc.collect()
    ctypes.CDLL(None).__lsan_do_recoverable_leak_check()


def pytest_unconfigure():
    look()
