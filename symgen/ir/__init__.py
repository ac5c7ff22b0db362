"""The expression graph and the program: values between the stages."""
