"""The store of the latest values, which threads share."""

from symgen.base.latest import get_or_make


def test_the_latest_values_stay_and_others_are_made_again():
    store, made = {}, []

    def value_of(key):
        return get_or_make(store, key, lambda: made.append(key) or key * 10, 2)

    assert [value_of(key) for key in (1, 2, 1, 3, 1, 2)] == [10, 20, 10, 30, 10, 20]
    assert made == [1, 2, 3, 2] and list(store) == [1, 2]


def test_another_thread_may_remove_the_oldest_value_at_the_same_time():
    class Shared(dict):
        def __iter__(self):
            keys = list(self.keys())
            self.pop(keys[0], None)  # as the other thread does between here and the removal
            return iter(keys)

    store = Shared({1: 10, 2: 20})
    assert get_or_make(store, 3, lambda: 30, 2) == 30
    assert set(store.keys()) == {2, 3}
