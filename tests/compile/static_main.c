/* Two private copies of the library, of different types, in one program. */
int float_copy(void);
int double_copy(void);

int main(void)
{
    return float_copy() == (int)sizeof(float) && double_copy() == (int)sizeof(double) ? 0 : 1;
}
